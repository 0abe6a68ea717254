"""The search for one UAV's path."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from missions.scenario import Scenario, VehicleModel, load_scenario
from planner.cost.kernel import evaluate
from planner.find_path import EVALUATIONS, METHODS, NO_WISH, PathFound, Wish, find_path, vehicle_problem

SmallScenario = Callable[..., Scenario]

SHIPPED = load_scenario("radars")
LEADER, F1, F2, F3 = SHIPPED.vehicles[:4]


@pytest.fixture(scope="module")
def radars(small_scenario: SmallScenario) -> Scenario:
    return small_scenario()


def found(
    scenario: Scenario, vehicle: VehicleModel, *earlier: PathFound, method: str = "skein", seed: int = 1, **wish: Any
) -> PathFound:
    return find_path(
        scenario, vehicle, earlier, method=method, seed=seed, wish=Wish(**wish), threads=None, report=lambda *_: None
    )


@pytest.mark.parametrize("method", METHODS)
def test_every_method_keeps_to_the_budget_and_tells_the_exact_cost(radars: Scenario, method: str) -> None:
    told: list[tuple[int, int, float]] = []
    path = find_path(
        radars, F1, (), method=method, seed=1, wish=NO_WISH, threads=1, report=lambda *now: told.append(now)
    )
    settings = radars.search
    budget = settings.population * settings.iterations * EVALUATIONS
    assert 0 < path.evaluations <= budget
    costs, _ = evaluate(path.corners_m[1:-1].reshape(1, -1), path.problem, "graded")
    assert path.cost_km == costs[0] == path.history[-1][1]
    evaluations, best = np.array(path.history).T
    assert np.all(np.diff(evaluations) >= 0)
    assert np.all(np.diff(best) <= 0.0)
    assert [(done, cost) for done, _, cost in told] == list(path.history)
    assert {of for _, of, _ in told} == {budget}


def test_skein_finds_feasible_paths_on_a_small_budget_and_both_readings_agree(radars: Scenario) -> None:
    path = found(radars, F1)
    assert path.feasible
    interior = path.corners_m[1:-1].reshape(1, -1)
    assert evaluate(interior, path.problem, "published")[0][0] == path.cost_km


@pytest.mark.parametrize("method", ["skein", "pso"])
def test_every_attempt_every_seed_and_every_vehicle_has_its_own_chance(radars: Scenario, method: str) -> None:
    paths = [
        found(radars, F2, method=method),
        found(radars, F2, method=method, attempt=1),
        found(radars, F2, method=method, seed=2),
        found(radars, F3, method=method),
    ]
    for i, path in enumerate(paths):
        for other in paths[:i]:
            assert not np.array_equal(path.corners_m[1:-1], other.corners_m[1:-1])
    assert np.array_equal(found(radars, F2, method=method).corners_m, paths[0].corners_m)


def test_an_earlier_uav_in_the_way_is_avoided(radars: Scenario) -> None:
    """A UAV with nearly the same origin and target as another cannot have the same path."""
    first = found(radars, F2)
    assert len(first.problem.others) == 0
    twin = F2.model_copy(update={"origin": (0.0, 8300.0, 0.0), "target": (25000.0, 18800.0, 2500.0)})
    second = found(radars, twin, first)
    assert second.feasible
    assert second.problem.separations_m[0] > radars.limits.separation_m
    alongside = first.corners_m[1:-1].reshape(1, -1)
    _, terms = evaluate(alongside, second.problem, "published")
    assert terms[0, 3] > 0.0


def test_later_attempts_keep_wider_margins(radars: Scenario) -> None:
    first, later = (vehicle_problem(radars, F2, wish=Wish(attempt=attempt)) for attempt in (0, 2))
    assert np.all(later.obstacles[:, 4] > first.obstacles[:, 4])
    assert later.bounds.clearance_m > first.bounds.clearance_m


def test_a_wish_for_length_is_granted(radars: Scenario) -> None:
    longer = found(radars, F1, length_min_m=36000.0)
    assert longer.feasible
    flown = np.hypot(*np.diff(longer.corners_m[:, :2], axis=0).T).sum()
    assert flown > 36000.0 > np.hypot(*np.diff(found(radars, F1).corners_m[:, :2], axis=0).T).sum()


def test_nobody_is_expected_to_fly_slower_than_an_aircraft_can(small_scenario: SmallScenario) -> None:
    """Else the climb limits of a UAV with a short line would be those of no flight at all."""
    lines = [((0.0, 10000.0, 0.0), (33000.0, 10000.0, 1000.0)), ((0.0, 12000.0, 0.0), (2500.0, 13000.0, 300.0))]
    scenario = small_scenario(lines)
    far, near = (vehicle_problem(scenario, vehicle).bounds for vehicle in scenario.vehicles)
    assert near.slope_max >= far.slope_max > 0.0 > near.slope_min
