"""A turn on to a point: after the arc the point lies straight ahead, wherever it is."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from missions.reference.lead_in import end_of, turn_towards
from missions.reference.path import fillet

place = st.floats(-1000, 1000)


@given(place, place, st.floats(-10, 10), place, place, st.floats(20, 300))
def test_the_point_is_ahead_at_the_end_of_the_arc(
    x: float, y: float, course: float, point_x: float, point_y: float, radius: float
) -> None:
    arc = turn_towards(x, y, course, (point_x, point_y), radius)
    end_x, end_y = end_of(arc)
    assert 0 <= arc.length_m < 2 * math.pi * radius
    away = math.hypot(point_x - end_x, point_y - end_y)
    if away > 5.0:
        heading = course + arc.curvature * arc.length_m
        across = (point_y - end_y) * math.cos(heading) - (point_x - end_x) * math.sin(heading)
        along = (point_y - end_y) * math.sin(heading) + (point_x - end_x) * math.cos(heading)
        assert abs(across) < 1e-3 * away + 1e-3
        assert along > 0


def test_what_lies_ahead_needs_no_turn_and_what_lies_behind_a_half_one_and_more() -> None:
    assert turn_towards(0.0, 0.0, 0.0, (500.0, 0.0), 100.0).length_m == pytest.approx(0.0, abs=1e-6)
    assert turn_towards(0.0, 0.0, 0.0, (-500.0, 0.0), 100.0).length_m > math.pi * 100.0


def test_a_path_after_an_arc_begins_with_it_without_a_step() -> None:
    arc = turn_towards(10.0, 20.0, 1.0, (-400.0, 300.0), 80.0)
    path = fillet(np.array([end_of(arc), (-400.0, 300.0), (-400.0, 900.0)]), 50.0).after(arc)
    s = np.linspace(0.0, path.length_m, 2000)
    x, y, heading, _ = path.at(s)
    assert (x[0], y[0], heading[0]) == pytest.approx((10.0, 20.0, 1.0))
    assert np.hypot(np.diff(x), np.diff(y)).max() < 1.001 * s[1]
    assert path.corner_s_m[1] == pytest.approx(arc.length_m + math.dist(end_of(arc), (-400.0, 300.0)), rel=0.1)
