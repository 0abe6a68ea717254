"""Feedback linearisation (25)-(28) gives the wanted accelerations, and limits in the stated order."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from missions.airframe import GRAVITY_M_S2, drag_n, lift_max_n, thrust_max_n
from missions.scenario import load_scenario
from sitl.aircraft.linearisation import controls_for
from sitl.aircraft.point_mass import AirState, air_velocity, rk4_step

AIRFRAME = load_scenario("radars").airframe.airframe()._replace(shaft_power_w=1e5, static_thrust_n=1e4)
"""With so much power that gentle wishes stay inside the limits."""
REAL = load_scenario("radars").airframe.airframe()
wish = st.floats(-1.5, 1.5)
flying = st.builds(
    AirState, st.just(0.0), st.just(0.0), st.just(500.0), st.floats(22, 34), st.floats(-0.15, 0.15), st.floats(-3, 3)
)


@given(flying, st.floats(0.2, 2), wish, wish)
def test_the_aircraft_accelerates_as_wished(state: AirState, ahead: float, left: float, up: float) -> None:
    ux = ahead * math.cos(state.chi) - left * math.sin(state.chi)
    uy = ahead * math.sin(state.chi) + left * math.cos(state.chi)
    controls = controls_for(ux, uy, up, state, AIRFRAME)
    if controls.thrust == 0.0:
        return
    dt = 1e-4
    before, after = air_velocity(state), air_velocity(rk4_step(state, controls, (0.0, 0.0, 0.0), AIRFRAME, dt))
    assert [(b - a) / dt for a, b in zip(before, after, strict=True)] == pytest.approx([ux, uy, up], abs=2e-3)


@given(flying, st.floats(-30, 30), st.floats(-30, 30), st.floats(-30, 30))
def test_commands_stay_inside_the_limits(state: AirState, ux: float, uy: float, uh: float) -> None:
    controls = controls_for(ux, uy, uh, state, REAL)
    assert 0.0 <= controls.thrust <= thrust_max_n(state.V, REAL)
    assert 0.0 <= controls.lift <= lift_max_n(state.V, REAL)
    assert abs(controls.bank) <= REAL.bank_max


def test_drag_is_that_of_the_limited_lift() -> None:
    state = AirState(0, 0, 500, 20, 0, 0)
    controls = controls_for(0, 0, 20, state, AIRFRAME)
    assert controls.lift == lift_max_n(20, AIRFRAME)
    assert controls.thrust == pytest.approx(drag_n(20, controls.lift, AIRFRAME))


def test_level_flight_asks_for_weight_and_drag() -> None:
    controls = controls_for(0, 0, 0, AirState(0, 0, 0, 28, 0, 0.7), REAL)
    weight = REAL.mass_kg * GRAVITY_M_S2
    assert controls == pytest.approx((drag_n(28, weight, REAL), weight, 0))
