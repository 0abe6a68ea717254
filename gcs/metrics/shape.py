"""The shape of a formation over a flight, as the paper speaks of it: the leader ahead, the others evenly apart."""

import itertools
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.float64]


@dataclass(frozen=True)
class Shape:
    """What became of a formation whose first vehicle leads, while all are in the air.

    Attributes:
        lead_from_s: time from which the leader stays ahead; None when it is not ahead at the end.
        gap_min_m, gap_max_m: distance of followers that start beside each other; None for fewer than two.
        gap_change: largest deviation of such a distance from what it was at the start, as a part of it.
    """

    lead_from_s: float | None
    gap_min_m: float | None
    gap_max_m: float | None
    gap_change: float | None


def shape(positions_m: FloatArray, t_s: FloatArray, forward: tuple[float, float]) -> Shape:
    """Measure a formation.

    Args:
        positions_m: (n_uav, n_tick, 3), leader first; NaN where a vehicle is not in the air.
        t_s: (n_tick,).
        forward: the direction of flight in the plane.
    """
    together = np.isfinite(positions_m).all(axis=(0, 2))
    positions, times = positions_m[:, together], t_s[together]
    progress = positions[:, :, :2] @ np.array(forward)
    behind = np.flatnonzero((progress[1:] >= progress[0]).any(axis=0))
    first = 0 if not len(behind) else int(behind[-1]) + 1
    lead_from_s = float(times[first]) if first < len(times) else None
    sideways = positions[1:, 0, :2] @ np.array([-forward[1], forward[0]])
    beside = positions[1:][np.argsort(sideways)]
    gaps = [np.linalg.norm(one - other, axis=1) for one, other in itertools.pairwise(beside)]
    if not gaps:
        return Shape(lead_from_s, None, None, None)
    change = max(float(np.abs(gap / gap[0] - 1.0).max()) for gap in gaps)
    return Shape(lead_from_s, float(np.min(gaps)), float(np.max(gaps)), change)
