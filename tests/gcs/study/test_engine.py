"""Saturation is found from the thrust that was given."""

import numpy as np
import pytest

from gcs.study.engine import engine_use
from missions.airframe import thrust_max_n
from missions.scenario import load_scenario
from sitl.aircraft.actuators import lag_gains
from sitl.ticks import TICK_S

AIRFRAME = load_scenario("vee").airframe.airframe()


def test_ticks_at_which_all_or_nothing_was_asked_for_are_counted_through_the_lag() -> None:
    rng = np.random.default_rng(4)
    airspeed = rng.uniform(20.0, 35.0, 400)
    most = np.array([thrust_max_n(V, AIRFRAME) for V in airspeed])
    asked = np.clip(rng.normal(12.0, 12.0, 400), 0.0, most)
    thrust, share = np.empty(400), lag_gains(AIRFRAME, TICK_S).thrust
    now = 10.0
    for tick in range(400):
        now = thrust[tick] = now + share * (asked[tick] - now)
    found = engine_use(thrust, airspeed, AIRFRAME)
    assert found.saturated == pytest.approx(np.mean((asked == 0.0) | (asked == most), where=np.arange(400) > 0))
    assert 0.1 < found.saturated < 0.9
    assert found.effort_n_s == pytest.approx(np.abs(np.diff(thrust)).mean() / TICK_S)
