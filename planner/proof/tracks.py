"""The references of many UAVs as one: positions of all at once, and bounds of how they move between two instants."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from missions.reference import Reference
from planner.proof.pieces import Largest, Pieces

FloatArray = npt.NDArray[np.float64]
IntArray = npt.NDArray[np.int64]

KINK = 1e-6
"""A change of heading from one segment to the next, radians, that counts as a sharp corner."""
KINK_CURVATURE = 1e12
"""Of a sharp corner, 1/m: so much that no bound rests on it, and finite, so that it may be multiplied by 0."""


class Shape(NamedTuple):
    """Largest figures of a path over intervals of arc length, (n,): |dz/ds|, curvature in the plane
    (`KINK_CURVATURE` at a sharp corner), |d2z/ds2|."""

    slope: FloatArray
    curvature: FloatArray
    altitude_bend: FloatArray

    @property
    def bend(self) -> FloatArray:
        """Of the curve in space, over horizontal arc length."""
        return np.hypot(self.curvature, self.altitude_bend)

    @property
    def stretch(self) -> FloatArray:
        """Length of the curve in space for each metre of horizontal arc length."""
        return np.hypot(1.0, self.slope)


class Motion(NamedTuple):
    """Largest speed and largest acceleration over intervals of time, (n,)."""

    speed_m_s: FloatArray
    acceleration_m_s2: FloatArray


class Tracks:
    """Paths, altitudes and schedules of UAVs, in the order given; `row` says which UAV's is meant."""

    def __init__(self, references: Sequence[Reference]) -> None:
        self.lengths_m = np.array([reference.length_m for reference in references])
        self.durations_s = np.array([reference.duration_s for reference in references])
        self.segments = Pieces([_with_kinks(reference.path.segments) for reference in references])
        self.altitude = Pieces([reference.altitude for reference in references])
        self.schedule = Pieces([reference.schedule for reference in references])
        self._arrivals = Pieces([reference.schedule[:, [1, 0, 2, 3]] for reference in references])
        """The schedule's pieces by the arc length at which they begin."""
        self._curvature = Largest(self.segments, np.abs(self.segments.table[:, 4]))
        self._slope = Largest(self.altitude, _end_slopes(self.altitude))
        self._altitude_bend = Largest(self.altitude, 2.0 * np.abs(self.altitude.table[:, 3]))
        self._speed = Largest(self.schedule, _end_slopes(self.schedule))
        self._push = Largest(self.schedule, 2.0 * np.abs(self.schedule.table[:, 3]))

    def __len__(self) -> int:
        return len(self.lengths_m)

    def points(self, row: IntArray, s_m: FloatArray) -> FloatArray:
        """(n, 3) at arc lengths (n,)."""
        start, x, y, heading, curvature = self.segments.table[self.segments.index(row, s_m)].T
        along = s_m - start
        half = 0.5 * curvature * along
        chord = along * np.sinc(half / np.pi)
        z, _ = _quadratics(self.altitude, row, s_m)
        return np.stack([x + chord * np.cos(heading + half), y + chord * np.sin(heading + half), z], axis=-1)

    def headings(self, row: IntArray, s_m: FloatArray) -> FloatArray:
        """Of the paths at arc lengths (n,), radians."""
        start, _, _, heading, curvature = self.segments.table[self.segments.index(row, s_m)].T
        result: FloatArray = heading + curvature * (s_m - start)
        return result

    def slopes(self, row: IntArray, s_m: FloatArray) -> FloatArray:
        """dz/ds at arc lengths (n,)."""
        return _quadratics(self.altitude, row, s_m)[1]

    def progress(self, row: IntArray, t_s: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Arc lengths and horizontal ground speeds at times (n,)."""
        return _quadratics(self.schedule, row, t_s)

    def positions(self, row: IntArray, t_s: FloatArray) -> FloatArray:
        """(n, 3) at times (n,)."""
        return self.points(row, self.progress(row, t_s)[0])

    def shape(self, row: IntArray, start_m: FloatArray, end_m: FloatArray) -> Shape:
        """Of the paths between arc lengths."""
        return Shape(
            self._slope.over(row, start_m, end_m),
            self._curvature.over(row, start_m, end_m),
            self._altitude_bend.over(row, start_m, end_m),
        )

    def motion(self, row: IntArray, start_s: FloatArray, end_s: FloatArray) -> Motion:
        """Of the flights between times.

        With s' and s'' of the schedule and the curve c(s) in space, the velocity is c' s' and the acceleration
        c' s'' + c'' s'^2.
        """
        shape = self.shape(row, self.progress(row, start_s)[0], self.progress(row, end_s)[0])
        speed, push = self._speed.over(row, start_s, end_s), self._push.over(row, start_s, end_s)
        return Motion(speed * shape.stretch, push * shape.stretch + speed**2 * shape.bend)

    def fastest_m_s(self, row: int) -> FloatArray:
        """Largest horizontal ground speed on each segment of one UAV's path, (segments,), sharp corners left out."""
        mine = slice(self.segments.first[row], self.segments.last[row] + 1)
        start = self.segments.table[mine, 0]
        t_s = self.times(np.full(len(start) + 1, row), np.append(start, self.lengths_m[row]))
        fastest = self._speed.over(np.full(len(start), row), t_s[:-1], t_s[1:])
        return fastest[self.segments.table[mine, 4] < KINK_CURVATURE]

    def times(self, row: IntArray, s_m: FloatArray) -> FloatArray:
        """When arc lengths (n,) are reached: `progress` the other way round."""
        start, c0, c1, c2 = self._arrivals.table[self._arrivals.index(row, s_m)][:, [1, 0, 2, 3]].T
        beyond = s_m - c0
        result: FloatArray = start + 2.0 * beyond / (c1 + np.sqrt(np.maximum(c1**2 + 4.0 * c2 * beyond, 0.0)))
        return result


def _quadratics(pieces: Pieces, row: IntArray, u: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Values and first derivatives."""
    start, c0, c1, c2 = pieces.table[pieces.index(row, u)].T
    d = u - start
    return c0 + (c1 + c2 * d) * d, c1 + 2.0 * c2 * d


def _end_slopes(pieces: Pieces) -> FloatArray:
    """The largest |derivative| on each quadratic piece: at one of its ends."""
    _, _, c1, c2 = pieces.table.T
    result: FloatArray = np.maximum(np.abs(c1), np.abs(c1 + 2.0 * c2 * pieces.lengths))
    return result


def _with_kinks(segments: FloatArray) -> FloatArray:
    """Segments with one more, of no length and `KINK_CURVATURE`, at each sharp corner.

    It holds nowhere, but every interval touches it that goes through the corner.
    """
    start, _, _, heading, curvature = segments.T
    jump = heading[1:] - heading[:-1] - curvature[:-1] * np.diff(start)
    sharp = np.flatnonzero(np.abs((jump + np.pi) % (2 * np.pi) - np.pi) > KINK) + 1
    kinks = segments[sharp].copy()
    kinks[:, 4] = KINK_CURVATURE
    return np.insert(segments, sharp, kinks, axis=0)
