"""Vincenty's geodesics are those of PROJ, as far as anybody flies, and farther away still far away."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st
from pyproj import Geod

from missions.geodesic import direct, inverse

WGS84 = Geod(ellps="WGS84")
FARTHEST_M = 1.5e6
latitudes = st.floats(-90.0, 90.0)
longitudes = st.floats(-180.0, 180.0)
distances = st.floats(0.0, FARTHEST_M)


@given(latitudes, longitudes, distances)
def test_a_place_at_a_distance_and_an_azimuth_is_where_proj_has_it(
    lat_deg: float, azimuth_deg: float, distance_m: float
) -> None:
    phi, longitude = direct(math.radians(lat_deg), distance_m, math.radians(azimuth_deg))
    lon_deg, expected_deg, _ = WGS84.fwd(0.0, lat_deg, azimuth_deg, distance_m)
    assert WGS84.inv(math.degrees(longitude), math.degrees(phi), lon_deg, expected_deg)[2] < 1e-4


@given(latitudes, latitudes, longitudes)
def test_distance_and_azimuth_are_projs_or_it_is_far_away_in_both(
    lat_1_deg: float, lat_2_deg: float, lon_deg: float
) -> None:
    distance_m, azimuth = inverse(*map(math.radians, (lat_1_deg, lat_2_deg, lon_deg)))
    azimuth_deg, _, expected_m = WGS84.inv(0.0, lat_1_deg, lon_deg, lat_2_deg)
    if expected_m > FARTHEST_M:
        assert distance_m > FARTHEST_M - 1.0
        return
    assert distance_m == pytest.approx(expected_m, abs=1e-4)
    apart = azimuth - math.radians(azimuth_deg)
    assert abs(2.0 * distance_m * math.sin(apart / 2.0)) < 1e-4, "the same place"


@given(latitudes, longitudes, distances)
def test_near_places_too(lat_deg: float, azimuth_deg: float, distance_m: float) -> None:
    lon_deg, there_deg, _ = WGS84.fwd(0.0, lat_deg, azimuth_deg, distance_m)
    found_m, _ = inverse(*map(math.radians, (lat_deg, there_deg, lon_deg)))
    assert found_m == pytest.approx(distance_m, abs=1e-4)
