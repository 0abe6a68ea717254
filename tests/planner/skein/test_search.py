"""Skein's search: within its budget, the same twice, never a wrong cost, and as good as the best that is known."""

import itertools
import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from missions.scenario import load_scenario
from planner.cost.kernel import INFEASIBLE_KM, evaluate
from planner.find_path import vehicle_problem
from planner.skein.search import PathResult, skein_path

RADARS = load_scenario("radars")
LEADER_BEST_KM = 37.681
"""Of `radars`, alone, with the planner's margins: the best of long runs."""


def searched(problem: Any, waypoints: int = 6, **settings: Any) -> PathResult:
    return skein_path(problem, waypoints, **({"budget": 3000, "seed": 1, "report": lambda *_: None} | settings))


@pytest.mark.parametrize("budget", [1, 2, 9, 50, 199, 1000, 4001])
def test_the_budget_is_never_exceeded_and_progress_only_rises(draw_problem: Any, budget: int) -> None:
    problem, _ = draw_problem(np.random.default_rng(budget))
    told: list[tuple[int, float]] = []
    result = searched(problem, budget=budget, report=lambda *now: told.append(now))
    assert 1 <= result.nfev <= budget
    assert tuple(told) == result.history
    evaluations, costs = np.array(told).T
    assert np.all(np.diff(evaluations) >= 0)
    assert np.all(np.diff(costs) <= 0.0)
    assert told[-1] == (result.nfev, result.fun)


@settings(max_examples=12, deadline=None)
@given(seed=st.integers(0, 2**32), budget=st.sampled_from([20, 600, 3000]))
def test_its_cost_is_the_exact_cost_of_its_path(draw_problem: Any, seed: int, budget: int) -> None:
    """So a path that it calls feasible is feasible."""
    problem, _ = draw_problem(np.random.default_rng(seed))
    result = searched(problem, budget=budget, seed=seed)
    assert result.x.shape == (18,)
    costs, _ = evaluate(result.x[None], problem, "graded")
    assert result.fun == costs[0]


def test_the_same_bits_with_one_thread_and_two_and_every_time(draw_problem: Any) -> None:
    problem, _ = draw_problem(np.random.default_rng(11))
    first, second, alone = (searched(problem, threads=threads) for threads in (2, 2, 1))
    for other in (second, alone):
        assert np.array_equal(first.x, other.x)
        assert (first.fun, first.nfev, first.history) == (other.fun, other.nfev, other.history)
    assert not np.array_equal(searched(problem, seed=2).x, first.x)


class EnoughError(Exception):
    """Raised by a report."""


def test_a_report_may_stop_the_search(make_problem: Any) -> None:
    told: list[int] = []

    def report(evaluations: int, _: float) -> None:
        told.append(evaluations)
        if len(told) == 3:
            raise EnoughError

    with pytest.raises(EnoughError):
        searched(make_problem(radars=[(10000, 0, 500, 800, 800)]), report=report)
    assert len(told) == 3


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_the_leader_of_radars_is_within_a_thousandth_of_the_best_known(seed: int) -> None:
    result = searched(vehicle_problem(RADARS, RADARS.vehicles[0]), 12, budget=20000, seed=seed)
    assert result.fun == pytest.approx(LEADER_BEST_KM, rel=1e-3)


def test_a_wall_with_one_gap_is_passed_through_the_gap(make_problem: Any) -> None:
    wall = [(10000.0, y, 800.0, 5000.0, 100.0) for y in np.arange(-10000.0, 10001.0, 1000.0) if abs(y - 5000) > 1900]
    result = searched(make_problem(obstacles=wall), 8, budget=6000)
    assert result.fun < INFEASIBLE_KM
    corners = np.vstack([[0.0, 0.0, 0.0], result.x.reshape(-1, 3), [20000.0, 0.0, 1000.0]])
    assert np.interp(10000.0, corners[:, 0], corners[:, 1]) == pytest.approx(5000.0, abs=1200.0)


def test_over_level_ground_the_path_is_the_straight_line(make_problem: Any) -> None:
    result = searched(make_problem(), 4)
    assert result.fun < INFEASIBLE_KM
    assert np.abs(result.x.reshape(-1, 3)[:, 1]).max() < 1.0


def test_a_least_length_is_flown(make_problem: Any) -> None:
    problem = make_problem(length_min_m=26000.0)
    result = searched(problem, 8)
    assert result.fun < INFEASIBLE_KM
    corners = np.vstack([problem.origin_m, result.x.reshape(-1, 3), problem.target_m])
    flown = sum(math.dist(p, q) for p, q in itertools.pairwise(corners))
    assert 26000.0 <= flown < 26500.0


@pytest.mark.parametrize(("intensity", "crosses"), [(0.3, True), (1.0, False)])
def test_a_faint_radar_is_flown_through_and_a_strong_one_flown_round(
    make_problem: Any, intensity: float, crosses: bool
) -> None:
    wide = [(10000.0, 0.0, 500.0, 3000.0, 3000.0 * intensity)]
    problem = make_problem(radars=wide)
    result = searched(problem, budget=20000, seed=0)
    corners = problem.corners_m(result.x)
    t = np.linspace(0.0, 1.0, 200)[:, None]
    points = np.concatenate([p + t * (q - p) for p, q in itertools.pairwise(corners)])
    nearest = float(np.linalg.norm(points - wide[0][:3], axis=1).min())
    assert (nearest < 2500.0) == crosses
    assert result.fun < INFEASIBLE_KM
