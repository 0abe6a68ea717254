"""What the kernel is told of a scenario."""

import numpy as np
import pytest

from missions.scenario import Scenario, load_scenario
from planner.cost.constraints import with_progress
from planner.cost.problem import NO_MARGINS, PLANNING_MARGINS, path_problem

NOBODY = np.empty((0, 14, 4))


@pytest.fixture(scope="module")
def radars() -> Scenario:
    return load_scenario("radars")


def test_limits_come_with_the_margins_asked_for(radars: Scenario) -> None:
    limits = radars.limits
    plain = path_problem(radars, radars.vehicles[0], NOBODY, 28.0, NO_MARGINS)
    planned = path_problem(radars, radars.vehicles[0], NOBODY, 28.0, PLANNING_MARGINS)
    assert set(plain.obstacles[:, 4]) == {limits.obstacle_margin_m}
    assert set(planned.obstacles[:, 4]) == {limits.obstacle_margin_m + PLANNING_MARGINS.obstacle_m}
    assert plain.bounds.clearance_m == limits.clearance_m
    assert planned.bounds.clearance_m == limits.clearance_m + PLANNING_MARGINS.clearance_m


def test_a_margin_gives_way_to_where_the_target_stands(radars: Scenario) -> None:
    changes = {"target": (28000.0, 22000.0, radars.limits.clearance_m + 5.0)}
    low = radars.vehicles[0].model_copy(update=changes)
    problem = path_problem(radars, low, NOBODY, 28.0, PLANNING_MARGINS)
    assert problem.bounds.clearance_m == pytest.approx(radars.limits.clearance_m + 5.0, abs=0.01)


def test_slopes_are_limited_by_power_at_speed(radars: Scenario) -> None:
    slopes = [
        path_problem(radars, radars.vehicles[0], NOBODY, speed, NO_MARGINS).bounds.slope_max for speed in (20, 28, 32)
    ]
    assert slopes[0] > slopes[1] > slopes[2] > 0.0


def test_progress_runs_from_0_to_1_with_the_length_of_the_legs(radars: Scenario) -> None:
    problem = path_problem(radars, radars.vehicles[0], NOBODY, 28.0, NO_MARGINS)
    middle = problem.origin_m + 0.25 * (problem.target_m - problem.origin_m)
    progress = with_progress(problem.corners_m(middle), problem)
    assert progress[:, 3] == pytest.approx([0.0, 0.25, 1.0])
    assert np.array_equal(progress[:, :3], problem.corners_m(middle))
