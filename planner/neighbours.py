"""Which UAVs come near each other: found by trees over moments of the flight, not by trying all pairs."""

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt
from scipy.spatial import KDTree

FloatArray = npt.NDArray[np.float64]

MOMENTS = 65
"""At which positions are compared; between two of them everyone flies 1 / 64 of its path at most."""
STRETCH = 1.2
"""Progress is even along arcs between fillets, which are a little shorter than the legs."""


class Neighbours:
    """The paths of many UAVs, which all leave and arrive together and make even progress.

    Between moments a pair comes closer by at most half a step of each: none that does come closer than asked is left
    out.

    Args:
        progress: (m, 4) a UAV, from `planner.cost.constraints.with_progress`.
        distance_m: that counts as near.
    """

    def __init__(self, progress: Sequence[FloatArray], distance_m: float) -> None:
        self._tracks = np.array([_track(path) for path in progress])
        self._lengths = np.array([_length_m(path) for path in progress])
        self._distance_m = distance_m
        self._moved: set[int] = set()
        reach = distance_m + STRETCH * float(self._lengths.max()) / (MOMENTS - 1)
        self._near: list[set[int]] = [set() for _ in progress]
        for moment in range(MOMENTS):
            for i, j in KDTree(self._tracks[:, moment]).query_pairs(reach):
                self._near[i].add(j)
                self._near[j].add(i)

    def move(self, i: int, progress: FloatArray) -> None:
        """Give a UAV another path."""
        self._tracks[i], self._lengths[i] = _track(progress), _length_m(progress)
        self._moved.add(i)

    def of(self, i: int) -> list[int]:
        """The others, in order, that may come near one."""
        if i in self._moved:
            return self._close(i, [j for j in range(len(self._near)) if j != i])
        return sorted((self._near[i] - self._moved).union(self._close(i, sorted(self._moved))))

    def _close(self, i: int, others: list[int]) -> list[int]:
        """Which of the others come close at any moment."""
        apart = np.linalg.norm(self._tracks[others] - self._tracks[i], axis=2).min(axis=1)
        steps = 0.5 * STRETCH * (self._lengths[others] + self._lengths[i]) / (MOMENTS - 1)
        return [others[k] for k in np.flatnonzero(apart < self._distance_m + steps)]


def _track(progress: FloatArray) -> FloatArray:
    """(MOMENTS, 3) positions."""
    moments = np.linspace(0.0, 1.0, MOMENTS)
    return np.stack([np.interp(moments, progress[:, 3], progress[:, axis]) for axis in range(3)], axis=1)


def _length_m(progress: FloatArray) -> float:
    return float(np.linalg.norm(np.diff(progress[:, :3], axis=0), axis=1).sum())
