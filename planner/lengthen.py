"""Who must take a longer way to arrive with the others: whoever even the slowest flight brings there too soon."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import numpy.typing as npt

from missions.scenario import Scenario
from planner.find_path import Wish
from planner.schedule import arrival_window_s

FloatArray = npt.NDArray[np.float64]

SPARE = 1.03
"""Lengths are asked for with so much more: the window of arrivals must have some width."""


def too_short(corners_m: Sequence[FloatArray], wishes: Sequence[Wish], scenario: Scenario) -> dict[int, Wish]:
    """Wishes, with a least length, of the UAVs whose paths are too short.

    The others fly as fast as they can for it, so that as few as possible take a longer way.

    Args:
        corners_m: (m, 3) a UAV.
        wishes: so far; a UAV that already has as long a way as is asked for is left to the schedule, which says why
            it cannot be.
    """
    windows = [arrival_window_s(path, scenario) for path in corners_m]
    if None in windows:
        return {}
    soonest_s = max(window[0] for window in windows if window)
    again = {}
    for i, (path, window) in enumerate(zip(corners_m, windows, strict=True)):
        if window and window[1] < soonest_s:
            flown_m = float(np.hypot(*np.diff(path[:, :2], axis=0).T).sum())
            wanted_m = SPARE * flown_m * soonest_s / window[1]
            if wanted_m > wishes[i].length_min_m:
                again[i] = replace(wishes[i], length_min_m=wanted_m)
    return again
