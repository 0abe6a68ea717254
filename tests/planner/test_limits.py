"""Planned speeds and slopes against the airframe's own figures."""

import math

import pytest

from missions.scenario import load_scenario
from planner.limits import POWER_SHARE, airspeed_range_m_s, power_share, slope_range

RADARS = load_scenario("radars")


def test_planned_airspeeds_keep_their_distance_from_the_airframes() -> None:
    assert airspeed_range_m_s(RADARS) == (20.0, 34.0)


@pytest.mark.parametrize(("speed", "degrees"), [(28.0, 8.0), (30.0, 7.0), (35.0, 3.0)])
def test_full_power_climbs_as_the_scenario_says(speed: float, degrees: float) -> None:
    assert power_share(speed, math.sin(math.radians(degrees)), RADARS.airframe.airframe()) == pytest.approx(1, abs=0.06)


@pytest.mark.parametrize("speed", [26.0, 28.0, 30.0, 33.0])
def test_the_steepest_planned_slope_takes_the_share_of_power(speed: float) -> None:
    _, steepest = slope_range(RADARS, speed)
    share = power_share(speed, math.sin(math.atan(steepest)), RADARS.airframe.airframe())
    assert share == pytest.approx(POWER_SHARE, abs=2e-3)


def test_slow_flight_climbs_at_the_scenarios_angle() -> None:
    assert slope_range(RADARS, 21.0)[1] == pytest.approx(math.tan(math.radians(8)))


@pytest.mark.parametrize("speed", [22.0, 28.0, 33.0])
def test_no_descent_is_steeper_than_the_glide(speed: float) -> None:
    steepest, _ = slope_range(RADARS, speed)
    assert -0.16 < steepest < -0.05
    assert power_share(speed, math.sin(math.atan(steepest)), RADARS.airframe.airframe()) == pytest.approx(0, abs=5e-3)


def test_a_draggy_aircraft_descends_at_the_sink_rate() -> None:
    draggy = RADARS.airframe.model_copy(update={"drag_coefficient_zero_lift": 0.06})
    assert slope_range(RADARS.model_copy(update={"airframe": draggy}), 34.0)[0] == pytest.approx(-4.0 / 34.0)
