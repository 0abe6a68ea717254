"""Coming down: which approaches are flown, and how the ground is met."""

import contextlib
import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from missions.environment.terrain import NO_WAVE, Terrain
from missions.errors import InputError
from missions.scenario import load_scenario
from sitl.landing import approach_airspeed_m_s, check_approach, steepest_slope, with_flaps
from sitl.swarm import SwarmOptions, vehicle_configs

AIRFRAME = vehicle_configs(load_scenario("vee"), SwarmOptions(seed=1, delay_s=0.2))[0].airframe
FLAT = Terrain(0.0, NO_WAVE, ())


@given(st.floats(1, 500), st.floats(100, 8000))
def test_an_approach_is_refused_exactly_when_it_is_too_steep(height: float, distance: float) -> None:
    steepest = steepest_slope(AIRFRAME, 0.0)
    too_steep = pytest.raises(InputError, match="mission item 3: LAND")
    with too_steep if height > steepest * distance else contextlib.nullcontext():
        check_approach(3, (0.0, 0.0, height), (distance, 0.0, 0.0), AIRFRAME, FLAT, 0.0)


def test_a_landing_pattern_of_6_degrees_is_flown_in_a_breeze() -> None:
    assert steepest_slope(AIRFRAME, 4.0) > math.tan(math.radians(6.0))


def test_a_hill_before_the_touchdown_is_named_with_its_distance() -> None:
    hill = Terrain(0.0, NO_WAVE, ((60.0, 1000.0, 0.0, 150.0, 150.0),))
    with pytest.raises(InputError, match=r"item 2: LAND: the approach is -?\d+ m above the ground \d+ m before"):
        check_approach(2, (0.0, 0.0, 80.0), (1500.0, 0.0, 0.0), AIRFRAME, hill, 0.0)
    check_approach(2, (3000.0, 0.0, 80.0), (1500.0, 0.0, 0.0), AIRFRAME, hill, 0.0)


def test_flaps_are_what_lets_it_come_down_slowly() -> None:
    assert with_flaps(AIRFRAME).drag_coefficient_zero_lift > 2 * AIRFRAME.drag_coefficient_zero_lift
    assert AIRFRAME.airspeed_min_m_s < approach_airspeed_m_s(AIRFRAME) < AIRFRAME.airspeed_cruise_m_s
