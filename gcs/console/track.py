"""Where one vehicle has been, from what it has said of itself, and where it was in between."""

import math
from bisect import bisect_left, bisect_right
from collections import deque
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.float64]
Vector = tuple[float, float, float]
UNKNOWN: Vector = (math.nan, math.nan, math.nan)

KEPT = 8
"""Newest samples, to interpolate between."""
TRAIL_STEP_S = 0.5
"""Between two places that are kept of its way."""
TRAIL = 8000
"""So many are kept, and when there are twice as many the older half goes."""
AHEAD_S = 2.0
"""So long a vehicle that says nothing is shown flying on."""


class Sample(NamedTuple):
    """What a vehicle said of itself: metres and m/s in the local frame, radians."""

    t_s: float
    position_m: Vector
    velocity_m_s: Vector
    attitude_rad: Vector


class Track:
    """One vehicle's samples, in order of time."""

    def __init__(self) -> None:
        self._newest: deque[Sample] = deque(maxlen=KEPT)
        self._times: list[float] = []
        self._places: list[Vector] = []

    @property
    def newest_s(self) -> float:
        """Time of the newest sample; -inf without any."""
        return self._newest[-1].t_s if self._newest else -math.inf

    @property
    def step_s(self) -> float:
        """Between its newest samples; 0 without two of them."""
        return self._newest[-1].t_s - self._newest[-2].t_s if len(self._newest) > 1 else 0.0

    def add(self, sample: Sample) -> None:
        """Take a sample; one that is no newer than the last is left out."""
        if sample.t_s <= self.newest_s:
            return
        self._newest.append(sample)
        if self._times and sample.t_s - self._times[-1] < TRAIL_STEP_S:
            return
        self._times.append(sample.t_s)
        self._places.append(sample.position_m)
        if len(self._times) >= 2 * TRAIL:
            del self._times[:TRAIL], self._places[:TRAIL]

    def clear(self) -> None:
        """Forget all: its clock has begun anew."""
        self._newest.clear()
        self._times.clear()
        self._places.clear()

    def at(self, t_s: float) -> tuple[Vector, Vector]:
        """Position and attitude at a time, by the cubic through positions and velocities; NaN without any sample.

        Before the oldest sample that is kept it is that one, after the newest it is carried on for `AHEAD_S`.
        """
        if not self._newest:
            return UNKNOWN, UNKNOWN
        last = self._newest[-1]
        if t_s >= last.t_s:
            ahead_s = min(t_s - last.t_s, AHEAD_S)
            (x, y, z), (vx, vy, vz) = last.position_m, last.velocity_m_s
            return (x + ahead_s * vx, y + ahead_s * vy, z + ahead_s * vz), last.attitude_rad
        later = next(i for i, one in enumerate(self._newest) if one.t_s >= t_s)
        if later == 0:
            return self._newest[0].position_m, self._newest[0].attitude_rad
        return between(self._newest[later - 1], self._newest[later], t_s)

    def trail(self, t_s: FloatArray) -> FloatArray:
        """Positions (k, 3) at past times (k,), ascending; NaN where nothing is known."""
        if not self._times:
            return np.full((len(t_s), 3), np.nan)
        near = slice(max(0, bisect_left(self._times, t_s[0]) - 1), bisect_right(self._times, t_s[-1]) + 1)
        times, axes = self._times[near], np.array(self._places[near]).T
        return np.stack([np.interp(t_s, times, axis, left=np.nan) for axis in axes], axis=1)


def between(before: Sample, after: Sample, t_s: float) -> tuple[Vector, Vector]:
    """Position and attitude between two samples: Hermite's cubic, and angles by the shorter way.

    Plain floats: for the three numbers of one vehicle numpy takes almost four times as long.
    """
    span_s = after.t_s - before.t_s
    u = (t_s - before.t_s) / span_s
    w = 1.0 - u
    p0, p1 = (1.0 + 2.0 * u) * w * w, u * u * (1.0 + 2.0 * w)
    v0, v1 = span_s * u * w * w, -span_s * u * u * w

    def place(i: int) -> float:
        positions, velocities = (before.position_m, after.position_m), (before.velocity_m_s, after.velocity_m_s)
        return p0 * positions[0][i] + p1 * positions[1][i] + v0 * velocities[0][i] + v1 * velocities[1][i]

    def angle(i: int) -> float:
        a, b = before.attitude_rad[i], after.attitude_rad[i]
        return a + u * ((b - a + math.pi) % (2.0 * math.pi) - math.pi)

    return (place(0), place(1), place(2)), (angle(0), angle(1), angle(2))
