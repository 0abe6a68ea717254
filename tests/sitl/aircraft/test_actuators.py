"""Actuators are first-order lags, exact at any tick."""

import math

import pytest

from missions.scenario import load_scenario
from sitl.aircraft.actuators import lag_gains, lagged
from sitl.aircraft.point_mass import Controls

AIRFRAME = load_scenario("radars").airframe.airframe()


@pytest.mark.parametrize("dt", [0.04, 0.02, 0.1])
def test_a_step_is_63_percent_done_after_its_lag(dt: float) -> None:
    controls, gains = Controls(0, 0, 0), lag_gains(AIRFRAME, dt)
    for _ in range(round(AIRFRAME.bank_lag_s / dt)):
        controls = lagged(controls, Controls(10, 100, 1), gains)
    assert controls.bank == pytest.approx(1 - math.exp(-1))
    assert controls.lift > 100 * (1 - math.exp(-1)) > 10 * controls.thrust, "lift is faster than bank, thrust slower"
