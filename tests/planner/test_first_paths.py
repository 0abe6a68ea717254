"""The paths a search begins with."""

import numpy as np
import pytest

from missions.scenario import load_scenario
from planner.cost.problem import PLANNING_MARGINS, PathProblem, path_problem
from planner.first_paths import box, first_paths


@pytest.fixture(scope="module")
def problem() -> PathProblem:
    scenario = load_scenario("radars")
    return path_problem(scenario, scenario.vehicles[0], np.empty((0, 14, 4)), 28.0, PLANNING_MARGINS)


def test_the_first_is_the_straight_line(problem: PathProblem) -> None:
    line = np.linspace(problem.origin_m, problem.target_m, 14)[1:-1]
    paths = first_paths(problem, 12, 10, np.random.default_rng(0))
    assert paths[0].reshape(12, 3) == pytest.approx(line)


def test_all_lie_in_the_box_and_differ(problem: PathProblem) -> None:
    paths = first_paths(problem, 12, 200, np.random.default_rng(0)).reshape(200, 12, 3)
    low, high = box(problem)
    assert np.all((paths >= low) & (paths <= high))
    assert len(np.unique(paths[:, 5, 0])) > 190


def test_bends_are_smooth_and_climbs_possible(problem: PathProblem) -> None:
    paths = first_paths(problem, 12, 200, np.random.default_rng(0))
    for path in paths[:50]:
        corners = problem.corners_m(path)
        legs = np.diff(corners, axis=0)
        slopes = legs[:, 2] / np.hypot(legs[:, 0], legs[:, 1])
        assert np.all(slopes <= problem.bounds.slope_max * 1.02)
