"""The local frame loses nothing over the area, and is true to distance from its origin."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st
from pyproj import Geod

from missions.frame import LocalFrame

FRAME = LocalFrame(47.0, 8.0, 400.0)
inside = st.floats(-40_000, 40_000)


@given(x=inside, y=inside)
def test_there_and_back_is_within_a_millimetre(x: float, y: float) -> None:
    assert math.dist(FRAME.to_local(*FRAME.to_geodetic(x, y)), (x, y)) < 1e-3


@given(x=inside, y=inside)
def test_the_wire_is_within_a_centimetre_each_way(x: float, y: float) -> None:
    assert math.dist(FRAME.from_e7(*FRAME.to_e7(x, y)), (x, y)) < 0.0088


@given(x=inside, y=inside)
def test_distances_from_the_origin_are_geodesic(x: float, y: float) -> None:
    lat_deg, lon_deg = FRAME.to_geodetic(x, y)
    _, _, distance = Geod(ellps="WGS84").inv(8.0, 47.0, lon_deg, lat_deg)
    assert distance == pytest.approx(math.hypot(x, y), abs=1e-3)


def test_x_is_east_and_y_is_north() -> None:
    assert FRAME.to_local(47.01, 8.0)[1] > 1000
    assert FRAME.to_local(47.0, 8.01)[0] > 700
