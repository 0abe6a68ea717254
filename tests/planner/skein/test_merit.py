"""The merit and its gradient: against finite differences, and against the exact kernel."""

from typing import Any

import numpy as np
import numpy.typing as npt
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from planner.cost.kernel import INFEASIBLE_KM, evaluate, path_costs
from planner.cost.problem import PathProblem
from planner.skein.merit import limits_count, merit

FloatArray = npt.NDArray[np.float64]

STEP_M = 1e-3


def merit_of(
    corners: FloatArray, problem: PathProblem, crossed: Any, multipliers: FloatArray, rho: float, soft_m: float
) -> tuple[float, FloatArray, FloatArray]:
    """Value, limits and gradient."""
    limits, gradient = np.empty(len(multipliers)), np.empty_like(corners)
    value = merit(corners, problem, np.array(crossed, bool), multipliers, rho, soft_m, limits, gradient)
    return value, limits, gradient


def plain(corners: FloatArray, problem: PathProblem, rho: float = 1e-9, soft_m: float = 1e-3) -> Any:
    """The merit without multipliers, all radars crossed."""
    none = np.zeros(limits_count(len(corners) - 1, problem))
    return merit_of(corners, problem, np.ones(len(problem.radars)), none, rho, soft_m)


@settings(max_examples=80, deadline=None)
@given(seed=st.integers(0, 2**32))
def test_the_gradient_agrees_with_finite_differences_away_from_kinks(draw_problem: Any, seed: int) -> None:
    rng = np.random.default_rng(seed)
    problem, corners = draw_problem(rng)
    count = limits_count(len(corners) - 1, problem)
    multipliers = np.where(rng.random(count) < 0.5, 0.0, rng.exponential(1.0, count))
    given_merit = (problem, rng.random(3) < 0.5, multipliers, 10 ** rng.uniform(0, 2), 10 ** rng.uniform(0, 2))
    value, _, gradient = merit_of(corners, *given_merit)
    smooth = 0
    for k, axis in np.ndindex(len(corners) - 2, 3):
        one_sided = []
        for step in (STEP_M, -STEP_M):
            moved = corners.copy()
            moved[k + 1, axis] += step
            one_sided.append(1000.0 * (merit_of(moved, *given_merit)[0] - value) / step)
        size = max(1.0, *map(abs, one_sided))
        if abs(one_sided[0] - one_sided[1]) < 2e-3 * size:
            smooth += 1
            assert gradient[k + 1, axis] == pytest.approx(np.mean(one_sided), abs=5e-3 * size)
    assert smooth > 0


@settings(max_examples=40, deadline=None)
@given(seed=st.integers(0, 2**32))
def test_the_merit_never_jumps(draw_problem: Any, seed: int) -> None:
    """Not even where a thing with a multiplier comes into reach: past a thing, in steps, nothing changes by more than
    slopes allow."""
    rng = np.random.default_rng(seed)
    problem, corners = draw_problem(rng)
    problem = problem._replace(terrain=problem.terrain._replace(peaks=np.empty((0, 5))))
    count = limits_count(len(corners) - 1, problem)
    given_merit = (problem, np.zeros(3), rng.exponential(2.0, count), 10.0, 20.0)
    towards = rng.normal(size=3) * (1.0, 1.0, 0.1)
    steps = []
    for metres in np.arange(0.0, 60.0, 0.5):
        moved = corners.copy()
        moved[3] += metres * towards
        value, _, gradient = merit_of(moved, *given_merit)
        steps.append((value, float(gradient[3] @ towards) / 1000.0))
    values, slopes = np.array(steps).T
    most = 0.5 * np.maximum(np.abs(slopes[1:]), np.abs(slopes[:-1]))
    assert np.all(np.abs(np.diff(values)) <= 1.5 * most + 0.005)


def near_feasible(draw_problem: Any, seed: int) -> tuple[PathProblem, FloatArray]:
    """A problem with wide limits, and a mild path: about as often feasible as not."""
    rng = np.random.default_rng(seed)
    problem, corners = draw_problem(rng)
    wide = problem.bounds._replace(
        leg_min_m=300.0, leg_max_m=8000.0, z_max_m=3000.0, y_max_m=1e4, length_min_m=0.0, clearance_m=50.0,
        slope_max=0.3, slope_min=-0.3, fillet_radius_m=250.0,
    )  # fmt: skip
    line = problem.origin_m + np.linspace(0, 1, len(corners))[:, None] * (problem.target_m - problem.origin_m)
    line[1:-1, 2] += 300.0
    corners = line + 0.4 * (corners - line) * (0.5, 1.0, 0.2)
    keep = rng.permutation(3)[:1]
    return problem._replace(bounds=wide, obstacles=problem.obstacles[keep], others=problem.others[:1],
                            separations_m=problem.separations_m[:1]), corners  # fmt: skip


@settings(max_examples=100, deadline=None)
@given(seed=st.integers(0, 2**32))
def test_limits_are_kept_exactly_when_the_kernel_says_feasible(draw_problem: Any, seed: int) -> None:
    problem, corners = near_feasible(draw_problem, seed)
    worst_km = plain(corners, problem)[1].max()
    assume(abs(worst_km) > 1e-8)
    assert (worst_km < 0.0) == (path_costs(corners[None], problem)[0] < INFEASIBLE_KM)


@settings(max_examples=60, deadline=None)
@given(seed=st.integers(0, 2**32))
def test_the_merit_of_a_feasible_path_is_its_cost(draw_problem: Any, seed: int) -> None:
    problem, corners = near_feasible(draw_problem, seed)
    costs, terms = evaluate(corners[1:-1].reshape(1, -1), problem, "graded")
    assume(costs[0] < INFEASIBLE_KM)
    assume(terms[0, 1] < 50.0)
    assert plain(corners, problem)[0] == pytest.approx(costs[0], rel=1e-6)


def test_softness_lowers_the_clearance_that_counts(make_problem: Any) -> None:
    problem = make_problem()
    corners = np.linspace(problem.origin_m, problem.target_m, 6)
    hard, soft = (plain(corners, problem, soft_m=soft_m)[0] for soft_m in (1e-3, 50.0))
    assert hard == pytest.approx(path_costs(corners[None], problem)[0])
    assert hard < soft < hard + 1.0


def test_a_radar_kept_out_of_costs_nothing_but_its_limit(make_problem: Any) -> None:
    problem = make_problem(radars=[(10000, 300, 500, 800, 800)])
    corners = np.linspace(problem.origin_m, problem.target_m, 5)
    none = np.zeros(limits_count(4, problem))
    crossed, _, _ = merit_of(corners, problem, [True], none, 1e-9, 1.0)
    avoided, limits, _ = merit_of(corners, problem, [False], none, 1e-9, 1.0)
    _, terms = evaluate(corners[1:-1].reshape(1, -1), problem, "graded")
    assert crossed - avoided == pytest.approx(terms[0, 2])
    assert limits.max() == pytest.approx(0.5, abs=1e-2)
