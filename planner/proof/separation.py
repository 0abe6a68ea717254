"""How near UAVs come to each other at any instant, neighbours found by a tree: not all pairs are looked at."""

from dataclasses import dataclass, replace
from itertools import chain

import numpy as np
import numpy.typing as npt
from scipy.spatial import cKDTree

from planner.proof.bracket import RESOLUTION_M, Intervals, Least, least
from planner.proof.tracks import Tracks

FloatArray = npt.NDArray[np.float64]
IntArray = npt.NDArray[np.int64]

WINDOW_S = 4.0
"""Time is cut into windows; within one, a UAV stays in a ball about where it is at the window's middle."""


@dataclass(frozen=True)
class Separations:
    """What is known of distances between UAVs, until the first of each pair arrives.

    Attributes:
        nearest_m: (n,) no other UAV is ever nearer; infinite for a single one.
        pairs: (m, 2) those that come near enough to matter: first and second in the order of the tracks.
        of_pair: their least distances and when.
    """

    nearest_m: FloatArray
    pairs: IntArray
    of_pair: Least


def separations(tracks: Tracks, wanted_m: float) -> Separations:
    """Bracket the distances of all pairs that come nearer than `wanted_m` or than anyone else to one of the two."""
    pairs, enough, windows = _candidates(tracks, wanted_m)
    found = least(len(pairs), windows, lambda row, a, b: _apart(tracks, pairs[row], a, b), enough)
    found = replace(found, low=np.minimum(found.low, enough))  # in the windows left out it may be so near
    nearest = np.full(len(tracks), np.inf)
    for side in (0, 1):
        np.minimum.at(nearest, pairs[:, side], found.low)
    return Separations(nearest, pairs, found)


def _candidates(tracks: Tracks, wanted_m: float) -> tuple[IntArray, FloatArray, Intervals]:
    """Pairs; distances from which they do not matter; and the windows in which they may come nearer than that.

    Balls about the middles of windows lie in four dimensions: windows are so far apart along the fourth that no two
    of them are neighbours. One tree of all of them then serves all windows.
    """
    n = len(tracks)
    windows = np.ceil(tracks.durations_s / WINDOW_S).astype(np.int64)
    uav = np.repeat(np.arange(n), windows)
    window = np.arange(len(uav)) - np.repeat(np.cumsum(windows) - windows, windows)
    start = window.astype(np.float64) * WINDOW_S
    end, middle = np.minimum(start + WINDOW_S, tracks.durations_s[uav]), start + WINDOW_S / 2
    centres = tracks.positions(uav, middle)
    reach = tracks.motion(uav, start, start + WINDOW_S).speed_m_s * WINDOW_S / 2

    far = float(np.linalg.norm(np.ptp(centres, axis=0))) + wanted_m + 2.0 * float(reach.max()) + 1.0
    lifted = np.column_stack([centres, window * (2.0 * far)])
    tree = cKDTree(lifted)
    other = np.asarray(tree.query(lifted, k=2, distance_upper_bound=far)[1])[:, 1]
    met = np.flatnonzero(other < len(uav))
    # Where one of the two has arrived by the middle of the window, their distance there is none that is flown.
    met = met[middle[met] <= np.minimum(end[met], end[other[met]])]
    known = np.full(n, far)
    np.minimum.at(known, uav[met], np.linalg.norm(centres[met] - centres[other[met]], axis=1))
    matters = np.maximum(wanted_m, known) + RESOLUTION_M

    balls = tree.query_ball_point(lifted, matters[uav] + reach + reach.max(), return_sorted=False)
    here = np.repeat(np.arange(len(uav)), np.fromiter(map(len, balls), np.int64, len(balls)))
    there = np.fromiter(chain.from_iterable(balls), np.int64, len(here))
    here, there = np.minimum(here, there), np.maximum(here, there)
    here, there = np.divmod(np.unique((here * len(uav) + there)[here != there]), len(uav))
    apart = np.linalg.norm(centres[here] - centres[there], axis=1) - reach[here] - reach[there]
    near = apart < np.maximum(matters[uav[here]], matters[uav[there]])
    here, there = here[near], there[near]
    # Balls are sorted by UAV, so `here` is of the UAV that comes first.
    code, row = np.unique(uav[here] * n + uav[there], return_inverse=True)
    pairs = np.column_stack(np.divmod(code, n))
    enough = matters[pairs].max(axis=1)
    return pairs, enough, Intervals(row, start[here], np.minimum(end[here], end[there]))


def _apart(tracks: Tracks, pairs: IntArray, a: FloatArray, b: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Bounds of the distance of pairs (n, 2) within [a, b], a value that it does not exceed somewhere, and when.

    The relative position stays near its chord: within h^2 / 8 times the largest relative acceleration, and within
    h / 2 times the largest relative speed (an ellipse about the chord's ends).
    """
    one, two = pairs.T
    first = tracks.positions(one, a) - tracks.positions(two, a)
    last = tracks.positions(one, b) - tracks.positions(two, b)
    chord = last - first
    squares = np.maximum(np.einsum("ij,ij->i", chord, chord), 1e-12)
    part = np.clip(-np.einsum("ij,ij->i", first, chord) / squares, 0.0, 1.0)
    distance = np.linalg.norm(first + part[:, None] * chord, axis=1)
    motion, other = tracks.motion(one, a, b), tracks.motion(two, a, b)
    bend = (motion.acceleration_m_s2 + other.acceleration_m_s2) * (b - a) ** 2 / 8
    lower = distance - np.minimum(bend, (motion.speed_m_s + other.speed_m_s) * (b - a) / 2)
    reached = np.array([distance + bend, np.linalg.norm(first, axis=1), np.linalg.norm(last, axis=1)])
    at = np.array([a + part * (b - a), a, b])
    best = np.argmin(reached, axis=0)
    return lower, np.take_along_axis(reached, best[None], 0)[0], np.take_along_axis(at, best[None], 0)[0]
