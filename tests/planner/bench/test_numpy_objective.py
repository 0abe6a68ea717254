"""The objective twice: compiled, and in plain numpy."""

import numpy as np
import pytest

from planner.bench.kernel_speed import on_raster
from planner.bench.numpy_objective import evaluate_in_numpy
from planner.bench.problems import bench_problem
from planner.cost.kernel import evaluate
from planner.cost.problem import PathProblem
from planner.search.waves import wave_view


def assert_equal(problem: PathProblem, waypoints: int, spread: float) -> None:
    numbers = np.random.default_rng(3).uniform(-spread, spread, (40, 3 * waypoints))
    paths = wave_view(problem, waypoints).interiors(numbers)
    costs, terms = evaluate(paths, problem, "graded")
    numpy_costs, numpy_terms = evaluate_in_numpy(paths, problem)
    assert numpy_costs == pytest.approx(costs, abs=2e-6, rel=1e-9)
    assert numpy_terms == pytest.approx(terms, rel=1e-7, abs=1e-9)


@pytest.mark.parametrize("spread", [0.02, 0.2, 1.0])
@pytest.mark.parametrize("name", ["radars-leader", "mountains-F3", "cylinders-12-3", "canyons-5-1", "walls-10-2"])
def test_both_say_the_same(name: str, spread: float) -> None:
    problem = bench_problem(name)
    assert_equal(problem.problem, problem.waypoints, spread)


def test_both_say_the_same_of_mountains_on_a_raster() -> None:
    problem = bench_problem("mountains-leader")
    assert_equal(on_raster(problem.problem), problem.waypoints, 0.2)


def test_both_know_the_least_length() -> None:
    problem = bench_problem("radars-F2")
    longer = problem.problem._replace(bounds=problem.problem.bounds._replace(length_min_m=33000.0))
    assert_equal(longer, problem.waypoints, 0.2)


def test_other_uavs_are_not_known() -> None:
    problem = bench_problem("radars-F2").problem._replace(others=np.zeros((1, 14, 4)))
    with pytest.raises(ValueError, match="neither other UAVs nor a datum wave"):
        evaluate_in_numpy(np.zeros((1, 36)), problem)
