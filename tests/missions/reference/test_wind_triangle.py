"""Airspeed and ground speed on a track are each other's inverse."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from missions.reference import airspeed_on_track, ground_speed_on_track

wind = st.tuples(st.floats(-8, 8), st.floats(-8, 8))


@given(st.floats(15, 45), st.floats(-0.2, 0.2), st.floats(-math.pi, math.pi), wind)
def test_round_trip(ground: float, slope: float, heading: float, blowing: tuple[float, float]) -> None:
    airspeed = airspeed_on_track(ground, slope, heading, blowing)
    assert ground_speed_on_track(airspeed, slope, heading, blowing) == pytest.approx(ground)


def test_headwind_and_tailwind() -> None:
    assert ground_speed_on_track(30, 0, 0, (-5, 0)) == pytest.approx(25)
    assert ground_speed_on_track(30, 0, 0, (5, 0)) == pytest.approx(35)
    assert ground_speed_on_track(5, 0, 0, (0, 3)) == pytest.approx(4)


@pytest.mark.parametrize("blowing", [(-21.0, 0.0), (0.0, 21.0)])
def test_too_much_wind_is_an_error(blowing: tuple[float, float]) -> None:
    with pytest.raises(ValueError, match="lets nothing through"):
        ground_speed_on_track(20, 0, 0, blowing)
