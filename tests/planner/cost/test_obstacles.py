"""Distances of legs from cylinders against dense samples."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from missions.environment.obstacles import Obstacle, wall_distances_m
from planner.cost.obstacles import least_wall_distance_m

TOWER = Obstacle(0.0, 0.0, 500.0, 1000.0)
point = st.tuples(st.floats(-3000, 3000), st.floats(-3000, 3000), st.floats(0, 2500))


@settings(max_examples=100, deadline=None)
@given(p=point, q=point)
def test_least_distance_is_that_of_dense_samples(p: tuple[float, ...], q: tuple[float, ...]) -> None:
    start, end = np.array(p), np.array(q)
    samples = start + np.linspace(0, 1, 20001)[:, None] * (end - start)
    expected = float(wall_distances_m(samples, TOWER).min())
    found = least_wall_distance_m(start, end, np.array([*TOWER, 1e9]))
    assert max(found, 0.0) == pytest.approx(expected, abs=0.3)


def test_through_the_middle_it_is_negative_by_the_way_out() -> None:
    level = least_wall_distance_m(np.array([-3000.0, 0, 400]), np.array([3000.0, 0, 400]), np.array([*TOWER, 100.0]))
    assert level == pytest.approx(-500.0, abs=1e-3)
    near_top = least_wall_distance_m(np.array([-3000.0, 0, 900]), np.array([3000.0, 0, 900]), np.array([*TOWER, 100.0]))
    assert near_top == pytest.approx(-100.0, abs=1e-3)


def test_over_the_top_and_standing_still() -> None:
    tower = np.array([*TOWER, 1e9])
    assert least_wall_distance_m(np.array([-900.0, 0, 1070]), np.array([900.0, 0, 1070]), tower) == pytest.approx(70.0)
    assert least_wall_distance_m(np.array([800.0, 0, 5]), np.array([800.0, 0, 5]), tower) == pytest.approx(300.0)


def test_far_away_it_is_infinite() -> None:
    far = least_wall_distance_m(np.array([-3000.0, 700, 0]), np.array([3000.0, 700, 0]), np.array([*TOWER, 199.0]))
    assert far == math.inf
