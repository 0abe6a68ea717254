"""Which places of a formation are kept when there are fewer vehicles than places, and who takes which."""

from collections.abc import Mapping
from typing import Any

import numpy as np
import numpy.typing as npt
from scipy.optimize import linear_sum_assignment

from missions.scenario import Scenario

FloatArray = npt.NDArray[np.float64]


def ranks(scenario: Scenario) -> dict[int, Any]:
    """By sysid, what places go by: the lower, the longer they are kept.

    On a route those further ahead come first, and of those abreast the ones nearer to its middle; without slots, the
    scenario's order, which is that of priority.
    """
    vehicles = scenario.vehicles
    if scenario.route is None:
        return {vehicle.sysid: i for i, vehicle in enumerate(vehicles)}
    return {one.sysid: (one.slot.behind_m, abs(one.slot.left_m)) for one in vehicles if one.slot is not None}


def kept(rank_of: Mapping[int, Any], count: int) -> tuple[list[int], list[int]]:
    """The places that are kept for `count` vehicles: those certain, and those of equal rank of which as many as are
    then left over are; in order of sysid."""
    if count == 0:
        return [], []
    last = sorted(rank_of.values())[count - 1]
    places = sorted(rank_of)
    return [place for place in places if rank_of[place] < last], [place for place in places if rank_of[place] == last]


def assigned(from_m: FloatArray, to_m: FloatArray, certain: int) -> npt.NDArray[np.int64]:
    """Who goes where: for each of n vehicles one of m >= n places, at the least sum of squared distances.

    With squares, not distances, the vectors between any two vehicles before and after make no obtuse angle: else the
    two had better swapped. Flown straight, evenly and at the same time, they pass each other nowhere: they stay at
    least as far apart as 1 / sqrt(2) times the lesser of their distances at either end. Many short moves are preferred
    to a long one.

    Args:
        from_m: (n, 3) positions of the vehicles.
        to_m: (m, 3) of the places.
        certain: as many of the places, the first ones, are taken in any case.

    Returns:
        (n,) index of each vehicle's place.
    """
    squares = np.sum((from_m[:, None] - to_m[None]) ** 2, axis=2)
    squares[:, certain:] += squares.sum() + 1.0
    return np.asarray(linear_sum_assignment(squares)[1], dtype=np.int64)
