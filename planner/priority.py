"""Paths in order of priority, each avoiding the earlier ones in time (Wang 2007, MODEL section 3).

Most UAVs meet nobody: all are planned alone first, side by side. Then, in order, whoever comes too close to an earlier
one is planned again with those near it to avoid. Where that leaves no path, the earlier UAV that stands most in its
way yields instead.
"""

from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor

import numba
import numpy as np

from missions.scenario import Scenario
from planner.cost.constraints import with_progress
from planner.cost.kernel import path_cost
from planner.cost.problem import PLANNING_MARGINS, separations_m
from planner.find_path import PathFound
from planner.infeasible import require_feasible
from planner.neighbours import Neighbours

Search = Callable[[int, Sequence[PathFound]], PathFound]
"""Plans the path of a UAV, by its number, that avoids others."""
SWAPS = 3
"""Times that UAVs may be put before others, for each UAV there is."""


def search_alone(count: int, search: Search, *, side_by_side: bool) -> list[PathFound]:
    """Plan each UAV as if nobody else flew; side by side when a search uses one thread only."""
    with ThreadPoolExecutor(numba.get_num_threads() if side_by_side else 1) as pool:
        return list(pool.map(lambda i: search(i, ()), range(count)))


def without_conflicts(scenario: Scenario, alone: Sequence[PathFound], search: Search) -> list[PathFound]:
    """Paths of all UAVs that keep their distance.

    Args:
        scenario: whose vehicles, in order of priority.
        alone: a feasible path of each, as if nobody else flew.
        search: plans one of them again.

    Raises:
        InputError: a UAV finds no path beside another, whichever of them goes first; names both.
    """
    names = [vehicle.name for vehicle in scenario.vehicles]
    paths = list(alone)
    keep_m = scenario.limits.separation_m + PLANNING_MARGINS.separation_m
    neighbours = Neighbours([with_progress(path.corners_m, path.problem) for path in paths], keep_m)
    order = list(range(len(paths)))
    swapped: set[tuple[int, int]] = set()
    place = 0

    def move(i: int, path: PathFound) -> None:
        if path is not paths[i]:
            paths[i] = path
            neighbours.move(i, with_progress(path.corners_m, path.problem))

    def too_close(i: int) -> list[int]:
        """Earlier UAVs that one's path comes too close to."""
        before = set(order[:place])
        return [j for j in neighbours.of(i) if j in before and conflict_km(scenario, paths[i], paths[j]) > 0.0]

    while place < len(order):
        i = order[place]
        move(i, alone[i])
        avoided: list[int] = []
        while new := [j for j in too_close(i) if j not in avoided]:
            avoided = sorted([*avoided, *new])
            move(i, search(i, [paths[j] for j in avoided]))
            if not paths[i].feasible:
                break
        if paths[i].feasible:
            place += 1
            continue
        blocker = max(avoided, key=lambda j: conflict_km(scenario, paths[i], paths[j]))
        if (i, blocker) in swapped or len(swapped) == SWAPS * len(order):
            require_feasible(names[i], paths[i], avoided=[names[j] for j in avoided])
        swapped.add((i, blocker))
        order.remove(i)
        place = order.index(blocker)
        order.insert(place, i)
    return paths


def conflict_km(scenario: Scenario, path: PathFound, other: PathFound) -> float:
    """What a path costs more, by f_C, for one other UAV (9)-(10)."""
    there, limit_m = with_progress(other.corners_m, other.problem)[None], scenario.limits.separation_m
    ends = path.corners_m[0], path.corners_m[-1]
    problem = path.problem._replace(
        others=there,
        separations_m=separations_m(there, *ends, limit_m, PLANNING_MARGINS),
        obstacles=np.empty((0, 5)),
    )
    terms = np.empty(5)
    path_cost(path.corners_m, problem, True, terms)
    return float(terms[3])
