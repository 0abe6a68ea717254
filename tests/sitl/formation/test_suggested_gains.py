"""Suggested gains: no others nearby damp better, and they keep their bounds."""

from dataclasses import replace

import numpy as np
import pytest

from missions.scenario import load_scenario
from sitl.formation.damping import decay_rate
from sitl.formation.graph import edges, laplacian
from sitl.formation.law import Gains
from sitl.formation.linear_formation import LinearFormation, modes
from sitl.formation.margin import aircraft_margin_s
from sitl.formation.plant import aircraft_rates
from sitl.formation.suggested_gains import suggested_gains

AIRFRAME = load_scenario("radars").airframe.airframe()
FLOWN = Gains(0.2, 0.8, 0.4, 0.01)
NINE = range(1, 10)


def formation(kind: str) -> LinearFormation:
    return LinearFormation(laplacian(NINE, edges(kind, NINE)), FLOWN, np.ones(9))


def decay(of: LinearFormation, gains: Gains, delay_s: float) -> float:
    return decay_rate(modes(replace(of, gains=gains)), gains, aircraft_rates(AIRFRAME), delay_s)


@pytest.mark.parametrize(("kind", "delay_s"), [("ring", 0.2), ("complete", 0.4), ("line", 2.0)])
def test_they_damp_better_than_those_flown_and_than_any_of_many_others(kind: str, delay_s: float) -> None:
    of = formation(kind)
    found = suggested_gains(of, AIRFRAME, delay_s)
    best = decay(of, found, delay_s)
    assert best > 1.5 * decay(of, FLOWN, delay_s)
    assert aircraft_margin_s(replace(of, gains=found), AIRFRAME) > 1.3 * delay_s
    assert found.k0 == FLOWN.k0
    assert 0.2 <= found.k3 <= 0.926
    rng = np.random.default_rng(1)
    for _ in range(100):
        k1, k2 = np.array(found[:2]) * np.exp(rng.normal(0.0, 0.3, 2))
        k3 = float(np.clip(found.k3 * np.exp(rng.normal(0.0, 0.3)), 0.2, 0.926))
        assert decay(of, Gains(k1, k2, k3, found.k0), delay_s) < 1.01 * best


def test_they_are_the_same_each_time() -> None:
    first, second = (suggested_gains(formation("star"), AIRFRAME, 0.2) for _ in range(2))
    assert first == second


def test_a_gain_that_does_nothing_stays_as_it_is() -> None:
    """The bare law of which nobody is pinned has no k3."""
    unpinned = LinearFormation(formation("ring").laplacian, FLOWN, np.zeros(9), bare=True)
    assert suggested_gains(unpinned, AIRFRAME, 0.2).k3 == FLOWN.k3
