"""Paths as sine waves."""

import numpy as np
import pytest

from missions.scenario import load_scenario
from planner.cost.kernel import evaluate
from planner.cost.problem import PLANNING_MARGINS, PathProblem, path_problem
from planner.search.waves import wave_view


@pytest.fixture(scope="module")
def problem() -> PathProblem:
    scenario = load_scenario("radars")
    return path_problem(scenario, scenario.vehicles[0], np.empty((0, 14, 4)), 28.0, PLANNING_MARGINS)


def test_zero_is_the_straight_line(problem: PathProblem) -> None:
    view = wave_view(problem, 12)
    line = np.linspace(problem.origin_m, problem.target_m, 14)[1:-1]
    assert view.interiors(np.zeros((1, 36))).reshape(12, 3) == pytest.approx(line)


def test_every_path_has_its_numbers(problem: PathProblem) -> None:
    view = wave_view(problem, 12)
    paths = np.random.default_rng(0).uniform(0.0, 4000.0, (20, 36))
    assert view.interiors(view.numbers(paths)) == pytest.approx(paths)


def test_costs_are_those_of_the_paths(problem: PathProblem) -> None:
    view = wave_view(problem, 12)
    numbers = np.random.default_rng(0).uniform(-0.1, 0.1, (20, 36))
    assert np.array_equal(view.fun(numbers), evaluate(view.interiors(numbers), problem, "graded")[0])


def test_random_numbers_are_smooth_paths(problem: PathProblem) -> None:
    numbers = np.random.default_rng(0).uniform(-0.3, 0.3, (200, 36))
    bends = [np.diff(problem.corners_m(path)[:, :2], axis=0) for path in wave_view(problem, 12).interiors(numbers)]
    turns = [np.abs(np.diff(np.unwrap(np.arctan2(legs[:, 1], legs[:, 0])))).max() for legs in bends]
    assert np.median(turns) < np.radians(60.0)
