"""Distances of legs, with their gradients, against dense samples and finite differences."""

import math
from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from planner.skein.distances import sphere_distance, wall_distance

STEP_M = 1e-3
TOWER = np.array([100.0, -50.0, 300.0, 400.0, 150.0])

Distance = Callable[[np.ndarray, np.ndarray], tuple[float, float, float, float, float]]


def to_sphere(p: np.ndarray, q: np.ndarray) -> tuple[float, float, float, float, float]:
    found: tuple[float, float, float, float, float] = sphere_distance(p, q, 100.0, -50.0, 200.0)
    return found


def to_wall(p: np.ndarray, q: np.ndarray) -> tuple[float, float, float, float, float]:
    found: tuple[float, float, float, float, float] = wall_distance(p, q, TOWER, math.inf)
    return found


@settings(max_examples=200, deadline=None)
@given(seed=st.integers(0, 2**32), distance=st.sampled_from([to_sphere, to_wall]))
def test_gradient_agrees_with_finite_differences(seed: int, distance: Distance) -> None:
    """Of walls, beside, above, round the rim, and inside."""
    rng = np.random.default_rng(seed)
    ends = rng.normal(size=(2, 3)) * (500.0, 500.0, 300.0) + (100.0, -50.0, 250.0)
    here, t, *away = distance(*ends)
    for end, axis in np.ndindex(2, 3):
        one_sided = []
        for step in (STEP_M, -STEP_M):
            moved = ends.copy()
            moved[end, axis] += step
            one_sided.append((distance(*moved)[0] - here) / step)
        assume(abs(one_sided[0] - one_sided[1]) < 2e-3)
        assert (t if end else 1.0 - t) * away[axis] == pytest.approx(np.mean(one_sided), abs=5e-3)


@settings(max_examples=100, deadline=None)
@given(seed=st.integers(0, 2**32))
def test_distance_is_the_least_over_the_leg(seed: int) -> None:
    rng = np.random.default_rng(seed)
    p, q = rng.normal(size=(2, 3)) * (500.0, 500.0, 300.0) + (100.0, -50.0, 250.0)
    points = p + np.linspace(0.0, 1.0, 20001)[:, None] * (q - p)
    to_centre = np.linalg.norm(points - (100.0, -50.0, 200.0), axis=1).min()
    beside = np.hypot(points[:, 0] - TOWER[0], points[:, 1] - TOWER[1]) - TOWER[2]
    above = points[:, 2] - TOWER[3]
    outside = np.hypot(np.maximum(beside, 0.0), np.maximum(above, 0.0))
    signed = np.where(outside > 0.0, outside, np.maximum(beside, above)).min()
    assert to_sphere(p, q)[0] == pytest.approx(to_centre, abs=0.05)
    assert to_wall(p, q)[0] == pytest.approx(signed, abs=0.1)


def test_a_wall_out_of_reach_is_infinitely_far() -> None:
    p, q = np.array([-1000.0, 400.0, 100.0]), np.array([1000.0, 400.0, 100.0])
    assert wall_distance(p, q, TOWER, 149.0)[0] == math.inf
    assert wall_distance(p, q, TOWER, 151.0)[0] == pytest.approx(150.0)
