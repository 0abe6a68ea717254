"""Loiter circles that would come too close are stacked."""

from itertools import combinations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from missions.errors import InputError
from planner.loiter import STACK_M, Circle, meeting, stack


def test_circles_far_apart_stay_where_they_are() -> None:
    circles = [Circle(0, 0, 500, 100), Circle(401, 0, 500, 100)]
    assert stack(["a", "b"], circles, 200.0, 1000.0) == circles


def test_circles_too_close_are_lifted_one_step_each() -> None:
    circles = [Circle(50.0 * i, 0, 200, 100) for i in range(3)]
    assert [c.z_m for c in stack(["a", "b", "c"], circles, 75.0, 600.0)] == [
        200.0,
        200.0 + STACK_M,
        200.0 + 2 * STACK_M,
    ]


def test_only_circles_that_come_close_push_each_other() -> None:
    circles = [Circle(0, 0, 200, 100), Circle(250, 0, 200, 100), Circle(500, 0, 200, 100)]
    assert [c.z_m for c in stack(["a", "b", "c"], circles, 75.0, 600.0)] == [200.0, 240.0, 200.0]


def test_a_circle_within_another_is_close_only_if_its_edge_is() -> None:
    assert stack(["a", "b"], [Circle(0, 0, 200, 500), Circle(10, 0, 200, 100)], 75.0, 600.0)[1].z_m == 200.0
    assert stack(["a", "b"], [Circle(0, 0, 200, 150), Circle(10, 0, 200, 100)], 75.0, 600.0)[1].z_m == 240.0


def test_no_room_below_the_highest_altitude_is_an_error_that_names_the_vehicle() -> None:
    with pytest.raises(InputError, match=r"b: its loiter, stacked above others at 240 m, .*altitude_max_m = 230"):
        stack(["a", "b"], [Circle(0, 0, 200, 100)] * 2, 75.0, 230.0)


@settings(max_examples=25, deadline=None)
@given(seed=st.integers(0, 2**32), count=st.integers(1, 9), separation=st.floats(10.0, 300.0))
def test_stacked_circles_do_not_meet_and_circles_at_one_altitude_meet_where_they_are_near(
    seed: int, count: int, separation: float
) -> None:
    rng = np.random.default_rng(seed)
    level = [Circle(x, y, 300.0, r) for x, y, r in rng.uniform([0, 0, 100], [2000, 2000, 250], (count, 3)).tolist()]
    assert meeting(stack([""] * count, level, separation, 1e4), separation) == []
    angle = np.linspace(0.0, 2 * np.pi, 120)
    rounds = [np.column_stack([c.x_m + c.radius_m * np.cos(angle), c.y_m + c.radius_m * np.sin(angle)]) for c in level]
    met = meeting(level, separation)
    for i, j in combinations(range(count), 2):
        nearest = float(np.linalg.norm(rounds[i][:, None] - rounds[j][None], axis=2).min())
        if abs(nearest - separation) > 12.0:
            assert ((i, j) in met) == (nearest < separation)
