"""The local frame loses nothing over the area, and is true to distance from its origin."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st
from pyproj import Geod, Proj

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


@given(lat_deg=st.floats(-85.0, 85.0), lon_deg=st.floats(-180.0, 180.0), x=st.floats(-7e5, 7e5), y=st.floats(-7e5, 7e5))
def test_it_is_projs_azimuthal_equidistant_projection(lat_deg: float, lon_deg: float, x: float, y: float) -> None:
    frame = LocalFrame(lat_deg, lon_deg, 0.0)
    projection = Proj(proj="aeqd", ellps="WGS84", lat_0=lat_deg, lon_0=lon_deg)
    there_lat_deg, there_lon_deg = frame.to_geodetic(x, y)
    assert abs(there_lon_deg) <= 180.0
    assert math.dist(projection(there_lon_deg, there_lat_deg), (x, y)) < 1e-3
    assert math.dist(frame.to_local(there_lat_deg, there_lon_deg), (x, y)) < 1e-3


@given(lat_e7=st.integers(-(2**31), 2**31 - 1), lon_e7=st.integers(-(2**31), 2**31 - 1))
def test_whatever_the_wire_says_is_a_place_in_reach_or_far_away(lat_e7: int, lon_e7: int) -> None:
    distance_m = math.hypot(*FRAME.from_e7(lat_e7, lon_e7))
    expected_m = math.hypot(*Proj(proj="aeqd", ellps="WGS84", lat_0=47.0, lon_0=8.0)(lon_e7 / 1e7, lat_e7 / 1e7))
    assert distance_m == pytest.approx(expected_m, abs=1e-4) or min(distance_m, expected_m) > 1.5e6


def test_x_is_east_and_y_is_north() -> None:
    assert FRAME.to_local(47.01, 8.0)[1] > 1000
    assert FRAME.to_local(47.0, 8.01)[0] > 700
