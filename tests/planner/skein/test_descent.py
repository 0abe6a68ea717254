"""Descent goes down, to the bottom where there is one, and counts what it takes."""

from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from planner.cost.kernel import INFEASIBLE_KM, path_costs
from planner.skein.descent import descend, polish
from planner.skein.merit import limits_count, merit
from planner.skein.tightened import tightened


def descended(corners: np.ndarray, problem: Any, *, steps: int = 200, most: int = 10**6) -> tuple[np.ndarray, int]:
    moved = corners.copy()
    none = np.zeros(limits_count(len(corners) - 1, problem))
    hessian = np.eye(3 * (len(corners) - 2))
    crossed = np.ones(len(problem.radars), bool)
    return moved, descend(moved, problem, crossed, none, 10.0, 20.0, steps, most, 1e-12, hessian)


def value_of(corners: np.ndarray, problem: Any) -> float:
    limits = np.zeros(limits_count(len(corners) - 1, problem))
    crossed = np.ones(len(problem.radars), bool)
    value: float = merit(corners, problem, crossed, limits * 0.0, 10.0, 20.0, limits, corners * 0.0)
    return value


def polished(corners: np.ndarray, problem: Any, allowance: int, rounds: int = 5) -> tuple[np.ndarray, float, int]:
    none = np.zeros(limits_count(len(corners) - 1, problem))
    best, crossed = corners.copy(), np.ones(len(problem.radars), bool)
    cost, _, used = polish(
        corners.copy(), tightened(problem), problem, crossed, none, 10.0, 50.0, rounds, 80, 1e-6, allowance, best
    )
    return best, cost, used


@settings(max_examples=30, deadline=None)
@given(seed=st.integers(0, 2**32), most=st.integers(1, 60))
def test_descent_goes_down_within_its_gradients(draw_problem: Any, seed: int, most: int) -> None:
    problem, corners = draw_problem(np.random.default_rng(seed))
    found, gradients = descended(corners, problem, most=most)
    assert 1 <= gradients <= most
    assert value_of(found, problem) <= value_of(corners, problem)
    assert np.array_equal(found[[0, -1]], corners[[0, -1]])


def test_over_level_ground_the_bottom_is_the_same_from_anywhere(make_problem: Any) -> None:
    """Length, terrain and altitude terms alone make a nearly convex problem."""
    problem = make_problem()
    line = np.linspace(problem.origin_m, problem.target_m, 7)
    rng = np.random.default_rng(2)
    values = []
    for _ in range(4):
        bent = line.copy()
        bent[1:-1] += rng.normal(size=(5, 3)) * (300.0, 1500.0, 100.0)
        found, _ = descended(bent, problem, steps=400)
        assert np.abs(found[:, 1]).max() < 1.0
        values.append(value_of(found, problem))
    assert np.ptp(values) < 1e-4


@settings(max_examples=20, deadline=None)
@given(seed=st.integers(0, 2**32), allowance=st.integers(1, 2000))
def test_the_cost_of_the_best_is_its_exact_cost_and_the_allowance_holds(
    draw_problem: Any, seed: int, allowance: int
) -> None:
    problem, corners = draw_problem(np.random.default_rng(seed))
    best, cost, used = polished(corners, problem, allowance)
    assert used <= max(allowance, 0)
    if np.isfinite(cost):
        assert cost == path_costs(best[None], problem)[0]
    else:
        assert np.array_equal(best, corners)


def test_a_path_through_a_wall_is_led_round_it(make_problem: Any) -> None:
    problem = make_problem(obstacles=[(10000.0, 100.0, 600.0, 3000.0, 100.0)])
    line = np.linspace(problem.origin_m, problem.target_m, 8)
    line[1:-1, 2] += 100.0
    best, cost, _ = polished(line, problem, 6000)
    assert cost < INFEASIBLE_KM
    beside = np.hypot(best[1:-1, 0] - 10000.0, best[1:-1, 1] - 100.0).min()
    assert beside == pytest.approx(700.0, abs=600.0)
    assert best[1:-1, 1].min() < 0.0  # the shorter side
