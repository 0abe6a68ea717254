"""Who yields to whom: with searches that choose from given paths, and with real ones in tight places."""

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
import pytest

from missions.errors import InputError
from missions.scenario import Scenario
from planner.cost.constraints import with_progress
from planner.cost.kernel import path_costs
from planner.find_path import PathFound, vehicle_problem
from planner.plan import plan
from planner.priority import conflict_km, search_alone, without_conflicts
from planner.verify import verify

SmallScenario = Callable[..., Scenario]
Bend = float

CROSSING = [
    ((0.0, 10000.0, 0.0), (25000.0, 20000.0, 2000.0)),
    ((0.0, 20000.0, 0.0), (25000.0, 10000.0, 2000.0)),
]


class Chooser:
    """A search that takes the first of a UAV's given bends, metres upwards, on which it meets nobody."""

    def __init__(self, scenario: Scenario, bends: Sequence[Sequence[Bend]]) -> None:
        self.scenario, self.bends = scenario, bends
        self.calls: list[tuple[int, int]] = []

    def __call__(self, i: int, avoided: Sequence[PathFound]) -> PathFound:
        self.calls.append((i, len(avoided)))
        others = [with_progress(path.corners_m, path.problem) for path in avoided]
        problem = vehicle_problem(self.scenario, self.scenario.vehicles[i], others)
        part = np.linspace(0.0, 1.0, self.scenario.search.waypoints + 2)
        line = problem.origin_m + part[:, None] * (problem.target_m - problem.origin_m)
        paths = np.array([line + np.outer(1.0 - np.abs(2.0 * part - 1.0), (0.0, 0.0, bend)) for bend in self.bends[i]])
        costs = path_costs(paths, problem)
        best = int(np.argmax(costs < 1e9)) if (costs < 1e9).any() else 0
        return PathFound(problem, paths[best], float(costs[best]), len(paths), ())


def settled(scenario: Scenario, bends: Sequence[Sequence[Bend]]) -> tuple[list[PathFound], Chooser]:
    choose = Chooser(scenario, bends)
    return without_conflicts(scenario, [choose(i, ()) for i in range(len(bends))], choose), choose


def bend_of(path: PathFound) -> float:
    line = np.linspace(path.corners_m[0], path.corners_m[-1], len(path.corners_m))
    off = (path.corners_m - line)[:, 2]
    return round(float(off.max()), 6)


@pytest.fixture(scope="module")
def crossing(small_scenario: SmallScenario) -> Scenario:
    return small_scenario(CROSSING, waypoints=5, radars=(), obstacles=())


def test_who_meets_nobody_is_left_alone(small_scenario: SmallScenario) -> None:
    beside = [((0.0, y, 0.0), (25000.0, y, 2000.0)) for y in (10000.0, 12000.0, 14000.0)]
    paths, choose = settled(small_scenario(beside, waypoints=5, radars=(), obstacles=()), [[0.0]] * 3)
    assert choose.calls == [(0, 0), (1, 0), (2, 0)]
    assert [bend_of(path) for path in paths] == [0.0, 0.0, 0.0]


def test_the_later_uav_yields(crossing: Scenario) -> None:
    paths, _ = settled(crossing, [[0.0, 380.0], [0.0, 380.0]])
    assert bend_of(paths[0]) == 0.0
    assert bend_of(paths[1]) > 300.0
    assert conflict_km(crossing, paths[1], paths[0]) == 0.0


def test_a_later_uav_without_a_way_makes_the_earlier_one_yield(crossing: Scenario) -> None:
    paths, _ = settled(crossing, [[0.0, 380.0], [0.0]])
    assert bend_of(paths[1]) == 0.0
    assert bend_of(paths[0]) > 300.0
    assert conflict_km(crossing, paths[0], paths[1]) == 0.0


def test_two_that_both_have_no_other_way_are_named(crossing: Scenario) -> None:
    with pytest.raises(InputError, match=r"U\d: no path found beside U\d, whichever goes first") as caught:
        settled(crossing, [[0.0], [0.0]])
    assert {"U1", "U2"} <= set(str(caught.value).replace(":", " ").replace(",", " ").split())


def test_a_conflict_costs_what_the_kernel_says(crossing: Scenario) -> None:
    paths, _ = settled(crossing, [[0.0], [380.0]])
    straight = Chooser(crossing, [[0.0], [0.0]])
    meeting = conflict_km(crossing, straight(1, ()), paths[0])
    assert meeting == conflict_km(crossing, straight(0, ()), straight(1, ())) > 100.0


def test_side_by_side_or_not_the_paths_are_those_of_each_alone() -> None:
    def search(i: int, avoided: Sequence[PathFound]) -> Any:
        return i, len(avoided)

    for side_by_side in (True, False):
        assert search_alone(5, search, side_by_side=side_by_side) == [(i, 0) for i in range(5)]


def test_two_that_want_the_same_crossing_at_the_same_time_get_a_verified_plan(crossing: Scenario) -> None:
    result = plan(crossing)
    assert verify(result, crossing).violations == ()
    straight = [uav.straight_line_m for uav in result.uavs]
    assert [uav.length_m for uav in result.uavs] == pytest.approx(straight, rel=0.02)


def test_three_that_change_places_in_a_narrow_corridor_get_a_verified_plan(small_scenario: SmallScenario) -> None:
    ends = [(9000.0, 11000.0), (10000.0, 9000.0), (11000.0, 10000.0)]
    scenario = small_scenario(
        [((0.0, y, 0.0), (25000.0, to, 2000.0)) for y, to in ends],
        waypoints=6,
        radars=(),
        obstacles=(),
        area=small_scenario().area.model_copy(update={"y_m": (8500.0, 11500.0)}),
    )
    result = plan(scenario)
    assert verify(result, scenario).violations == ()


def test_thirty_uavs_side_by_side_get_a_verified_plan(small_scenario: SmallScenario) -> None:
    """Through radars and round towers, each into the lane of its neighbour."""
    lanes = [2000.0 + 900.0 * i for i in range(30)]
    lines = [((0.0, y, 0.0), (25000.0, lanes[i ^ 1], 2500.0)) for i, y in enumerate(lanes)]
    scenario = small_scenario(lines, waypoints=6)
    result = plan(scenario)
    report = verify(result, scenario)
    assert report.violations == ()
    assert len(result.uavs) == 30
