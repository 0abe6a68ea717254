"""Areas to stay in and out of."""

import math
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from missions.errors import InputError
from missions.fence import Fence, FenceCircle, FencePolygon
from missions.frame import LocalFrame
from sitl.fence_watch import FenceAreas

FRAME = LocalFrame(46.5, 11.3, 0.0)
# An L: the square of 1000 m without its upper right quarter.
CORNERS = [(0, 0), (1000, 0), (1000, 500), (500, 500), (500, 1000), (0, 1000)]
L = FencePolygon(True, tuple(FRAME.to_e7(x, y) for x, y in CORNERS))
coordinate = st.floats(-200, 1200)


def in_the_l(x: float, y: float) -> bool:
    return 0 < x < 1000 and 0 < y < 1000 and not (x > 500 and y > 500)


@given(coordinate, coordinate)
def test_a_polygon_contains_what_it_should(x: float, y: float) -> None:
    on_edge = any(abs(value - edge) < 0.1 for value in (x, y) for edge in (0, 500, 1000))
    stay_in = FenceAreas(Fence((L,)), FRAME).crossed(x, y)
    stay_out = FenceAreas(Fence((FencePolygon(False, L.vertices),)), FRAME).crossed(x, y)
    if not on_edge:
        assert (stay_in is None) == in_the_l(x, y)
        assert (stay_out is None) != (stay_in is None)


@given(coordinate, coordinate)
def test_all_areas_must_allow_a_place(x: float, y: float) -> None:
    hole = FenceCircle(False, FRAME.to_e7(250, 250), 100.0)
    crossed = FenceAreas(Fence((L, hole)), FRAME).crossed(x, y)
    if FenceAreas(Fence((L,)), FRAME).crossed(x, y) is None and abs(math.hypot(x - 250, y - 250) - 100) > 0.1:
        assert (crossed is None) == (math.hypot(x - 250, y - 250) > 100)


@pytest.mark.parametrize("area", [FenceCircle(True, (0, 0), 10.0), FencePolygon(True, ((0, 0), (10, 0), (0, 10)))])
def test_areas_on_another_continent_are_refused(area: Any) -> None:
    with pytest.raises(InputError, match="1000 km"):
        FenceAreas(Fence((area,)), FRAME)
