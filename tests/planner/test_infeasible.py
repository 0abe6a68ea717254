"""Every kind of problem without a solution ends soon, and says who, what and where; never with a bad plan."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from missions.errors import InputError
from missions.scenario import Scenario
from planner.cost.kernel import path_costs
from planner.find_path import PathFound, vehicle_problem
from planner.infeasible import broken_limit, require_feasible, require_reachable
from planner.plan import plan

SmallScenario = Callable[..., Scenario]

LINE = ((0.0, 10000.0, 0.0), (25000.0, 10000.0, 2000.0))
LEVEL = np.linspace(*map(np.array, LINE), 8)


def found(scenario: Scenario, corners: np.ndarray, *others: np.ndarray) -> PathFound:
    """A path given by hand as what a search found."""
    problem = vehicle_problem(scenario, scenario.vehicles[0], others)
    return PathFound(problem, corners, float(path_costs(corners[None], problem)[0]), 7, ())


def moved(k: int, x: float = 0.0, y: float = 0.0, z: float = 0.0) -> np.ndarray:
    corners = LEVEL.copy()
    corners[k] += (x, y, z)
    return corners


@pytest.fixture(scope="module")
def open_scenario(small_scenario: SmallScenario) -> Scenario:
    return small_scenario([LINE], waypoints=6, radars=(), obstacles=())


def test_a_target_too_far_for_its_legs_says_so(small_scenario: SmallScenario) -> None:
    with pytest.raises(InputError, match=r"U1: target is 25\.1 km away, 2 legs of limits\.leg_max_m reach 16\.0 km"):
        plan(small_scenario([LINE], waypoints=1))


def test_a_climb_too_steep_for_any_path_says_so(small_scenario: SmallScenario) -> None:
    limits = small_scenario().limits.model_copy(update={"leg_max_m": 1500.0})
    high = ((0.0, 10000.0, 0.0), (6000.0, 10000.0, 3000.0))
    with pytest.raises(
        InputError, match=r"U1: no path of climb angle under \d\.\d deg: 3000 m of height in at most 10"
    ):
        plan(small_scenario([high], waypoints=6, limits=limits))


def test_a_target_nearer_than_a_leg_says_so(open_scenario: Scenario) -> None:
    problem = vehicle_problem(open_scenario, open_scenario.vehicles[0])
    near = problem._replace(target_m=np.array([100.0, 10000.0, 0.0]))
    with pytest.raises(InputError, match=r"U1: target is closer than limits\.leg_min_m = 300"):
        require_reachable("U1", near, 6)


def test_a_high_target_that_a_detour_reaches_is_reached(small_scenario: SmallScenario) -> None:
    high = ((0.0, 10000.0, 0.0), (12000.0, 12000.0, 2000.0))
    result = plan(small_scenario([high], radars=(), obstacles=()))
    assert result.uavs[0].length_m > 1.1 * result.uavs[0].straight_line_m


def tower(x_m: float, y_m: float, radius_m: float, scenario: Scenario) -> Any:
    where = {"x_m": x_m, "y_m": y_m, "radius_m": radius_m, "height_m": 9000.0}
    return scenario.obstacles[0].model_copy(update=where)


def test_a_target_boxed_in_by_obstacles_says_which(small_scenario: SmallScenario) -> None:
    given = small_scenario([LINE])
    ring = tuple(
        tower(25000.0 + 3000.0 * math.cos(turn), 10000.0 + 3000.0 * math.sin(turn), 600.0, given)
        for turn in np.linspace(0.0, 2.0 * math.pi, 20)
    )
    with pytest.raises(
        InputError,
        match=r"U1: no path found in \d{4} evaluations: the best comes \d+ m too close to obstacles\[\d+\] on",
    ) as caught:
        plan(small_scenario([LINE], obstacles=ring, radars=()))
    settings = given.search
    assert int(str(caught.value).split(" found in ")[1].split()[0]) <= settings.population * settings.iterations * 3


def test_a_wall_right_across_says_so(small_scenario: SmallScenario) -> None:
    given = small_scenario([LINE])
    fence = tuple(tower(12000.0, y, 700.0, given) for y in np.arange(0.0, 33000.0, 1300.0))
    with pytest.raises(
        InputError, match=r"U1: no path found .* too close to obstacles\[\d+\] on leg \d+, from \(\d+, "
    ):
        plan(small_scenario([LINE], obstacles=fence, radars=()))


def test_two_in_one_narrow_corridor_are_both_named(small_scenario: SmallScenario) -> None:
    """They would have to change sides where there is no room."""
    lines = [((0.0, 100.0, 0.0), (25000.0, 310.0, 2500.0)), ((0.0, 310.0, 0.0), (25000.0, 100.0, 2500.0))]
    area = small_scenario().area.model_copy(update={"y_m": (0.0, 400.0)})
    with pytest.raises(InputError, match=r"(U1: no path found beside U2|U2: no path found beside U1), whichever goes"):
        plan(small_scenario(lines, area=area, radars=(), obstacles=()))


@pytest.mark.parametrize(
    ("corners", "text"),
    [
        (
            moved(1, x=-3431.0, z=-270.0),
            r"has a leg 159 m too short on leg 1, from \(0, 10000, 0\) to \(140, 10000, 16\)",
        ),
        (moved(3, z=700.0), r"climbs at \d+\.\d deg on leg 3, .* m more than \d\.\d deg allow"),
        (moved(2, z=1500.0), r"(climbs|descends) at \d+\.\d deg on leg [23], "),
        (np.vstack([LEVEL[:4], LEVEL[3] + np.array([0, 0, 900.0]), LEVEL[5:]]), r"climbs at 90\.0 deg on leg 4, "),
        (moved(3, y=7000.0), r"turns by \d+ deg at \(10714, 17000"),
        (moved(4, y=-10100.0), r"has a leg 2717 m too long on leg 5"),
    ],
)
def test_each_limit_by_hand(open_scenario: Scenario, corners: np.ndarray, text: str) -> None:
    path = found(open_scenario, corners)
    assert not path.feasible
    with pytest.raises(InputError, match=f"U1: no path found in 7 evaluations: the best .*{text}"):
        require_feasible("U1", path)


def test_a_path_under_ground_says_where(open_scenario: Scenario) -> None:
    low = np.linspace((0.0, 10000.0, 0.0), (25000.0, 10000.0, 40.0), 8)
    assert "too close to the ground on leg" in broken_limit(found(open_scenario, low))


def test_a_path_too_short_says_by_how_much(open_scenario: Scenario) -> None:
    path = found(open_scenario, LEVEL)
    problem = path.problem._replace(bounds=path.problem.bounds._replace(length_min_m=30000.0))
    text = broken_limit(PathFound(problem, LEVEL, 2e9, 7, ()))
    assert text == "is 5000 m shorter than it must be to arrive with the others"


@pytest.mark.parametrize(("over_m", "said"), [(0.02, "0.1"), (3.14, "3.2"), (50.0, "50")])
def test_nothing_is_said_to_be_0_m_over(open_scenario: Scenario, over_m: float, said: str) -> None:
    path = found(open_scenario, LEVEL)
    problem = path.problem._replace(bounds=path.problem.bounds._replace(y_max_m=10000.0 - over_m))
    text = broken_limit(PathFound(problem, LEVEL, 2e9, 7, ()))
    assert text.startswith(f"lies {said} m outside the area (north) at ")


@pytest.mark.parametrize(("side", "limit", "value"), [("north", "y_max_m", 9950.0), ("west", "x_min_m", 3621.4)])
def test_a_path_outside_the_area_says_where(open_scenario: Scenario, side: str, limit: str, value: float) -> None:
    path = found(open_scenario, LEVEL)
    problem = path.problem._replace(bounds=path.problem.bounds._replace(**{limit: value}))
    text = broken_limit(PathFound(problem, LEVEL, 2e9, 7, ()))
    assert text == f"lies 50 m outside the area ({side}) at (3571, 10000, 286)"


def test_a_path_too_near_to_another_names_it(open_scenario: Scenario) -> None:
    other = np.column_stack([LEVEL, np.linspace(0.0, 1.0, 8)])
    other[:, 1] += [900.0, 500.0, 250.0, 100.0, 100.0, 250.0, 500.0, 900.0]
    path = found(open_scenario, LEVEL, other)
    assert "too close to U7 on leg" in broken_limit(path, ["U7"])
    assert "too close to another UAV on leg" in broken_limit(path)


def test_a_feasible_path_is_no_error(open_scenario: Scenario) -> None:
    path = found(open_scenario, LEVEL)
    assert path.feasible
    require_feasible("U1", path)
