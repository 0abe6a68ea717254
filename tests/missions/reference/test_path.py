"""A filleted path is smooth, keeps its corners' arcs inside the legs, and is the same point by point as in arrays."""

import itertools
import math

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from missions.reference.path import fillet, path_at

coordinate = st.floats(-5000, 5000)
polylines = st.lists(st.tuples(coordinate, coordinate), min_size=2, max_size=8)


def apart(points: list[tuple[float, float]], distance: float) -> bool:
    return all(math.dist(a, b) > distance for a, b in itertools.pairwise(points))


@settings(max_examples=200)
@given(polylines, st.floats(10, 400))
def test_the_path_is_continuous_and_as_long_as_it_says(points: list[tuple[float, float]], radius: float) -> None:
    assume(apart(points, 50))
    path = fillet(np.array(points), radius)
    s = np.linspace(0, path.length_m, 4000)
    x, y, _, _ = path.at(s)
    steps = np.hypot(np.diff(x), np.diff(y))
    assert steps.max() <= (s[1] - s[0]) * (1 + 1e-6)
    assert steps.sum() == pytest.approx(path.length_m, rel=2e-3)
    assert (x[-1], y[-1]) == pytest.approx(points[-1], abs=1e-6)


@given(polylines, st.floats(10, 400))
def test_one_point_at_a_time_is_the_same_path(points: list[tuple[float, float]], radius: float) -> None:
    assume(apart(points, 50))
    path = fillet(np.array(points), radius)
    rows, index = path.segments.tolist(), 0
    for s in np.linspace(-100, path.length_m + 100, 97):
        x, y, heading, curvature, index = path_at(float(s), index, rows)
        ax, ay, aheading, acurvature = path.at(np.array(s))
        assert (x, y, heading, curvature) == pytest.approx((ax, ay, aheading, acurvature), abs=1e-6)


def test_an_arc_touches_both_legs_and_turns_by_the_corner() -> None:
    path = fillet(np.array([[0, 0], [1000, 0], [1000, 1000.0]]), 200)
    assert path.length_m == pytest.approx(2000 - 400 + 100 * math.pi)
    assert path.corner_radius_m.tolist() == [math.inf, 200, math.inf]
    middle = path.at(path.corner_s_m[1:2])
    assert (middle[0][0], middle[1][0]) == pytest.approx(
        (1000 - 200 * (1 - math.sqrt(0.5)), 200 * (1 - math.sqrt(0.5)))
    )


def test_an_arc_that_does_not_fit_is_made_smaller() -> None:
    path = fillet(np.array([[0, 0], [100, 0], [100, 100.0], [200, 100]]), 200)
    assert 0 < path.corner_radius_m[1] <= 50.001


def test_doubled_corners_count_once_and_keep_their_place() -> None:
    path = fillet(np.array([[0, 0], [0, 0], [500, 0], [500, 0], [500, 500.0]]), 100)
    assert path.corner_s_m[0] == path.corner_s_m[1] == 0
    assert path.corner_s_m[2] == path.corner_s_m[3] > 0


def test_a_path_needs_two_places() -> None:
    with pytest.raises(ValueError, match="two corners"):
        fillet(np.zeros((3, 2)), 100)
