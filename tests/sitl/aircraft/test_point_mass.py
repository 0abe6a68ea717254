"""The point mass obeys (19)-(24) and its integration is accurate."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import solve_ivp

from missions.airframe import GRAVITY_M_S2, drag_n
from missions.scenario import load_scenario
from sitl.aircraft.point_mass import AirState, Controls, air_velocity, point_mass_rates, rk4_step, with_air_velocity

AIRFRAME = load_scenario("radars").airframe.airframe()
WEIGHT = AIRFRAME.mass_kg * GRAVITY_M_S2
STILL = (0.0, 0.0, 0.0)
flying = st.builds(
    AirState,
    st.floats(-1e4, 1e4),
    st.floats(-1e4, 1e4),
    st.floats(0, 4e3),
    st.floats(18, 36),
    st.floats(-0.3, 0.3),
    st.floats(-3, 3),
)


@given(flying, st.floats(0, 40), st.floats(60, 200), st.floats(-0.7, 0.7))
def test_energy_changes_by_the_work_of_thrust_and_drag(
    state: AirState, thrust: float, lift: float, bank: float
) -> None:
    drag = drag_n(state.V, lift, AIRFRAME)
    up, left = lift * math.cos(bank), lift * math.sin(bank)
    _, _, climb, acceleration, _, _ = point_mass_rates(
        state.V, state.gamma, state.chi, thrust - drag, up, left, AIRFRAME.mass_kg
    )
    power = AIRFRAME.mass_kg * (state.V * acceleration + GRAVITY_M_S2 * climb)
    assert power == pytest.approx((thrust - drag) * state.V, abs=1e-6)


@given(flying, st.floats(0, 40), st.floats(90, 130), st.floats(-0.7, 0.7))
def test_a_second_of_steps_is_within_a_millimetre_of_an_adaptive_solver(
    state: AirState, thrust: float, lift: float, bank: float
) -> None:
    controls = Controls(thrust, lift, bank)

    def rates(_: float, y: np.ndarray) -> tuple[float, ...]:
        surplus, up, left = thrust - drag_n(y[3], lift, AIRFRAME), lift * math.cos(bank), lift * math.sin(bank)
        return point_mass_rates(y[3], y[4], y[5], surplus, up, left, AIRFRAME.mass_kg)

    exact = solve_ivp(rates, (0, 1), state, rtol=1e-10, atol=1e-10).y[:, -1]
    for _ in range(25):
        state = rk4_step(state, controls, STILL, AIRFRAME, 0.04)
    assert math.dist(state[:3], exact[:3]) < 1e-3


def test_a_steady_turn_has_the_rate_of_its_bank() -> None:
    bank = math.radians(30)
    *_, climb_rate, turn_rate = point_mass_rates(25.0, 0.0, 1.0, 0.0, WEIGHT, WEIGHT * math.tan(bank), AIRFRAME.mass_kg)
    assert climb_rate == pytest.approx(0, abs=1e-12)
    assert turn_rate == pytest.approx(GRAVITY_M_S2 * math.tan(bank) / 25.0)


def test_wind_carries_the_aircraft() -> None:
    state = AirState(0, 0, 100, 25, 0, 0)
    controls = Controls(drag_n(25, WEIGHT, AIRFRAME), WEIGHT, 0.0)
    moved = rk4_step(state, controls, (3.0, -4.0, 0.5), AIRFRAME, 0.04)
    assert (moved.x, moved.y, moved.h) == pytest.approx((0.04 * 28, -0.16, 100.02))
    assert pytest.approx(25) == moved.V


@given(flying)
def test_air_velocity_round_trip(state: AirState) -> None:
    assert with_air_velocity(state, air_velocity(state)) == pytest.approx(state)
