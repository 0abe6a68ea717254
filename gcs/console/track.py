"""Where one vehicle has been, from what it has said of itself, and where it was in between."""

import math
from bisect import bisect_left, bisect_right
from collections import deque
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.float64]

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
    position_m: tuple[float, float, float]
    velocity_m_s: tuple[float, float, float]
    attitude_rad: tuple[float, float, float]


class Track:
    """One vehicle's samples, in order of time."""

    def __init__(self) -> None:
        self._newest: deque[Sample] = deque(maxlen=KEPT)
        self._times: list[float] = []
        self._places: list[tuple[float, float, float]] = []

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

    def at(self, t_s: float) -> tuple[FloatArray, FloatArray]:
        """Position and attitude, (3,) each, at a time; by the cubic through positions and velocities, NaN without any.

        Before the oldest sample that is kept it is that one, after the newest it is carried on for `AHEAD_S`.
        """
        if not self._newest:
            return np.full(3, np.nan), np.full(3, np.nan)
        later = next((i for i, one in enumerate(self._newest) if one.t_s >= t_s), None)
        if later is None:
            last = self._newest[-1]
            ahead_s = min(t_s - last.t_s, AHEAD_S)
            return np.array(last.position_m) + ahead_s * np.array(last.velocity_m_s), np.array(last.attitude_rad)
        if later == 0:
            first = self._newest[0]
            return np.array(first.position_m), np.array(first.attitude_rad)
        return between(self._newest[later - 1], self._newest[later], t_s)

    def trail(self, t_s: FloatArray) -> FloatArray:
        """Positions (k, 3) at past times (k,), ascending; NaN where nothing is known."""
        if not self._times:
            return np.full((len(t_s), 3), np.nan)
        near = slice(max(0, bisect_left(self._times, t_s[0]) - 1), bisect_right(self._times, t_s[-1]) + 1)
        times, axes = self._times[near], np.array(self._places[near]).T
        return np.stack([np.interp(t_s, times, axis, left=np.nan) for axis in axes], axis=1)


def between(before: Sample, after: Sample, t_s: float) -> tuple[FloatArray, FloatArray]:
    """Position and attitude between two samples: Hermite's cubic, and angles by the shorter way."""
    span_s = after.t_s - before.t_s
    u = (t_s - before.t_s) / span_s
    p0, p1 = np.array(before.position_m), np.array(after.position_m)
    v0, v1 = np.array(before.velocity_m_s) * span_s, np.array(after.velocity_m_s) * span_s
    position = (
        (1.0 + 2.0 * u) * (1.0 - u) ** 2 * p0 + u * (1.0 - u) ** 2 * v0 + u**2 * (3.0 - 2.0 * u) * p1
        - u**2 * (1.0 - u) * v1
    )  # fmt: skip
    a0 = np.array(before.attitude_rad)
    turn = (np.array(after.attitude_rad) - a0 + math.pi) % (2.0 * math.pi) - math.pi
    return position, a0 + u * turn
