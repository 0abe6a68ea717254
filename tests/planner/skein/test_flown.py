"""Lengths flown are the kernel's, and their slopes those of finite differences."""

from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from planner.cost.constraints import broken_limits
from planner.skein.flown import add_flown_slopes, fly

STEP_M = 1e-3


@settings(max_examples=100, deadline=None)
@given(seed=st.integers(0, 2**32), radius_m=st.sampled_from([0.0, 250.0, 3000.0]))
def test_arcs_are_those_of_the_kernel_and_slopes_are_exact(draw_problem: Any, seed: int, radius_m: float) -> None:
    """Also where a fillet has no room."""
    rng = np.random.default_rng(seed)
    problem, corners = draw_problem(rng)
    legs = len(corners) - 1
    by_across, by_arc, by_turn = rng.normal(size=legs), rng.normal(size=legs), rng.normal(size=legs + 1)

    def flown(path: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        across, turns, arcs = np.empty(legs), np.empty(legs + 1), np.empty(legs)
        fly(path, radius_m, across, turns, arcs)
        return across, turns, arcs

    def value(path: np.ndarray) -> float:
        across, turns, arcs = flown(path)
        return float((by_across @ across + by_arc @ arcs) / 1000.0 + by_turn @ np.abs(turns))

    across, turns, arcs = flown(corners)
    exact = np.empty(legs)
    broken_limits(corners, problem.bounds._replace(fillet_radius_m=radius_m), exact)
    assert arcs == pytest.approx(exact, rel=1e-9)
    gradient = np.zeros_like(corners)
    add_flown_slopes(corners, radius_m, across, turns, by_across.copy(), by_turn, by_arc, gradient)
    for k, axis in np.ndindex(corners.shape):
        moved, back = corners.copy(), corners.copy()
        moved[k, axis] += STEP_M
        back[k, axis] -= STEP_M
        one_sided = np.array([value(moved) - value(corners), value(corners) - value(back)]) * 1000.0 / STEP_M
        if abs(np.diff(one_sided)[0]) < 1e-3:
            assert gradient[k, axis] == pytest.approx(one_sided.mean(), abs=2e-3)
