"""What keeps the tightened limits keeps the real ones, and the ends stay possible."""

from typing import Any

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from planner.cost.kernel import INFEASIBLE_KM, path_costs
from planner.skein.merit import limits_count, merit
from planner.skein.tightened import tightened


def worst_limit_km(corners: np.ndarray, problem: Any, *, crossed: bool) -> float:
    limits = np.empty(limits_count(len(corners) - 1, problem))
    merit(corners, problem, np.full(len(problem.radars), crossed), np.zeros(len(limits)), 1.0, 1.0, limits, corners * 0)
    return float(limits.max())


@settings(max_examples=100, deadline=None)
@given(seed=st.integers(0, 2**32))
def test_no_limit_is_looser(draw_problem: Any, seed: int) -> None:
    """Each limit of a path is at least as far from being kept; those to other UAVs at the same times, which wider
    fillets shift by centimetres."""
    problem, corners = draw_problem(np.random.default_rng(seed))
    count = limits_count(len(corners) - 1, problem)
    real, tight, timed = np.empty((3, count))
    crossed, none = np.zeros(len(problem.radars), bool), np.zeros(count)
    merit(corners, problem, crossed, none, 1.0, 1.0, real, corners * 0)
    tighter = tightened(problem)
    merit(corners, tighter, crossed, none, 1.0, 1.0, tight, corners * 0)
    same_times = tighter.bounds._replace(fillet_radius_m=problem.bounds.fillet_radius_m)
    merit(corners, tighter._replace(bounds=same_times), crossed, none, 1.0, 1.0, timed, corners * 0)
    others = np.zeros(count, bool)
    others[:-1].reshape(len(corners) - 1, -1)[:, -len(problem.others) :] = True
    assert np.all(tight[~others] >= real[~others] - 1e-12)
    assert np.all(timed[others] >= real[others] - 1e-12)


@settings(max_examples=50, deadline=None)
@given(seed=st.integers(0, 2**32), gap_m=st.floats(0.0, 2.0))
def test_ends_that_keep_the_real_limits_keep_the_tightened_ones(make_problem: Any, seed: int, gap_m: float) -> None:
    """With an obstacle, another UAV and the ground hardly further away than they must be."""
    rng = np.random.default_rng(seed)
    bearing = rng.uniform(0.5, 1.5) * np.pi
    out = 300.0 + 100.0 + gap_m
    tower = (20000.0 - out * np.cos(bearing), out * np.sin(bearing), 300.0, 2000.0, 100.0)
    other = [[0.0, 300.0 + gap_m, 0.0, 0.0], [20000.0, 300.0 + gap_m, 100.0 + gap_m, 1.0]]
    problem = make_problem(obstacles=[tower], others=[other], target=(20000.0, 0.0, 100.0 + gap_m))
    tight = tightened(problem)
    assert tight.obstacles[0, 4] <= out - 300.0
    assert tight.separations_m[0] <= 300.0 + gap_m
    assert tight.bounds.clearance_m <= 100.0 + gap_m


def test_a_path_on_a_tightened_limit_is_feasible(make_problem: Any) -> None:
    """Climbing as steeply as the tightened problem allows."""
    problem = make_problem(target=(20000.0, 0.0, 1000.0), slope_max=0.06)
    steepest = tightened(problem).bounds.slope_max
    part = np.linspace(0.0, 1.0, 6)
    corners = np.column_stack([20000.0 * part, 0.0 * part, np.minimum(1000.0, 20000.0 * part * steepest)])
    assert worst_limit_km(corners, tightened(problem), crossed=True) <= 1e-12
    assert path_costs(corners[None], problem)[0] < INFEASIBLE_KM
