"""Rates of decay: against the exact matrix of the ticks, with the delay as a chain of them."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from missions.scenario import load_scenario
from sitl.formation.damping import decay_rate
from sitl.formation.graph import edges, laplacian
from sitl.formation.law import Gains
from sitl.formation.linear_formation import LinearFormation, Mode, common_mode, modes
from sitl.formation.plant import aircraft_plant, aircraft_rates
from sitl.ticks import TICK_S

AIRFRAME = load_scenario("radars").airframe.airframe()
SIX = range(1, 7)

gains = st.builds(Gains, st.floats(0.02, 0.6), st.floats(0.02, 1.5), st.floats(0.1, 0.9), st.floats(0.0, 0.05))


@settings(deadline=None, max_examples=40)
@given(st.sampled_from(["ring", "line", "star", "complete"]), gains, st.integers(1, 40))
def test_they_are_those_of_the_ticks(kind: str, gains: Gains, delay_ticks: int) -> None:
    formation = LinearFormation(laplacian(SIX, edges(kind, SIX)), gains, np.ones(6))
    apart = modes(formation)
    exact = min(tick_decay_rate(mode, gains, delay_ticks) for mode in apart)
    found = decay_rate(apart, gains, aircraft_rates(AIRFRAME), delay_ticks * TICK_S)
    assert abs(found - exact) < 0.01 * abs(exact) + 0.001


def test_the_whole_comes_back_to_its_schedule_as_slowly_as_the_pin_is_weak() -> None:
    """The slow root of s^2 + k3 s + k0, which the engine's lag and drag's slope hardly matter to."""
    gains = Gains(0.2, 0.8, 0.4, 0.01)
    formation = LinearFormation(laplacian(SIX, edges("ring", SIX)), gains, np.ones(6))
    found = decay_rate([common_mode(formation)], gains, aircraft_rates(AIRFRAME), 0.2)
    assert abs(found / 0.0268 - 1.0) < 0.01


def tick_decay_rate(mode: Mode, gains: Gains, delay_ticks: int) -> float:
    A, B = aircraft_plant(AIRFRAME)
    chain = np.zeros((3 + delay_ticks, 3 + delay_ticks))
    chain[:3, :3] = A - np.outer(B, [mode.pins[0], mode.damping[0], 0.0])
    chain[:3, -1] = -mode.block[0, 0] * B
    chain[3, :2] = gains.k1, gains.k2
    chain[4:, 3:-1] = np.eye(delay_ticks - 1)
    return float(-np.log(np.abs(np.linalg.eigvals(chain)).max()) / TICK_S)
