"""When a vehicle arrived, and how far it had flown by then."""

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from gcs.truth import H, X
from missions.reference import Reference
from sitl.ticks import TICK_S

FloatArray = npt.NDArray[np.float64]

AT_TARGET_M = 100.0
"""A crossing of the target's plane farther from the target than this is no arrival."""


@dataclass(frozen=True)
class Arrival:
    """How one vehicle's flight ended.

    Attributes:
        time_s: of crossing the plane through the target normal to the last leg, between ticks; None without arrival.
        tick: the first at or past that plane.
        length_m: flown until then, or in all without arrival; climbs included.
    """

    time_s: float | None
    tick: int | None
    length_m: float


def arrival(truth: FloatArray, reference: Reference) -> Arrival:
    """Find a vehicle's arrival.

    Args:
        truth: (n_tick, 6), as in `gcs.truth`.
        reference: what it was to fly.
    """
    positions = truth[:, X : H + 1]
    steps = np.linalg.norm(np.diff(positions, axis=0), axis=1)
    heading = reference.target_heading
    past = (positions[:, :2] - reference.target_m[:2]) @ np.array([math.cos(heading), math.sin(heading)])
    before = np.flatnonzero((past[:-1] < 0.0) & (past[1:] >= 0.0))
    part = past[before] / (past[before] - past[before + 1])
    crossings = positions[before] + part[:, None] * (positions[before + 1] - positions[before])
    near = np.flatnonzero(np.linalg.norm(crossings - np.array(reference.target_m), axis=1) <= AT_TARGET_M)
    if not len(near):
        return Arrival(None, None, float(steps.sum()))
    first = near[0]
    tick = int(before[first])
    flown = steps[:tick].sum() + part[first] * steps[tick]
    return Arrival((tick + float(part[first])) * TICK_S, tick + 1, float(flown))
