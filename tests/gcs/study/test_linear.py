"""The theory holds: what disturbs the linear formation dies out below the margin, and grows above it."""

import numpy as np
import pytest

from gcs.study.graphs import studied_graphs
from gcs.study.linear import growth_rate, growth_rate_sampled
from gcs.study.linear_sweep import growths
from missions.scenario import load_scenario
from sitl.formation.graph import edges, laplacian
from sitl.formation.law import Gains
from sitl.formation.linear_formation import LinearFormation
from sitl.formation.margin import margin_s, mode_margins
from sitl.ticks import TICK_S

VEE = load_scenario("vee")
GRAPHS = studied_graphs(VEE)
NINE = range(1, 10)


def bare(kind: str) -> LinearFormation:
    matrix = laplacian(NINE, edges(kind, NINE), unit_weights=True)
    return LinearFormation(matrix, Gains(0.2, 1.0, 1.0, 0.0), np.ones(9), bare=True)


@pytest.mark.parametrize("name", GRAPHS)
def test_disturbances_die_out_below_the_margin_and_grow_above_it(name: str) -> None:
    found = growths(VEE, name, GRAPHS[name])
    assert {growth.law for growth in found} == {"bare", "flown", "flown in ticks"}
    for growth in found:
        if abs(growth.share - 1.0) > 0.015:
            assert (growth.rate_1_s > 0.0) == (growth.share > 1.0), growth


@pytest.mark.parametrize(("kind", "margin"), [("ring", 0.4736), ("complete", 0.1855)])
def test_the_models_margins_show_to_a_thousandth(kind: str, margin: float) -> None:
    formation = bare(kind)
    assert growth_rate(formation, 0.998 * margin, 300.0) < 0.0 < growth_rate(formation, 1.002 * margin, 300.0)


def test_a_lone_decay_is_the_characteristic_roots() -> None:
    """Two that hear nobody: s^2 + k3 s + k0 = 0."""
    formation = LinearFormation(np.zeros((2, 2)), Gains(0.0, 0.0, 0.5, 0.04), np.ones(2))
    slowest = max(np.roots([1.0, 0.5, 0.04]).real)
    assert growth_rate(formation, 0.4, 100.0) == pytest.approx(slowest, rel=1e-3)


def test_between_ticks_the_last_stable_one_and_the_next_enclose_the_sampled_margin() -> None:
    formation = bare("ring")
    airframe = VEE.airframe.airframe()
    ticks = margin_s(mode_margins(formation, airframe), "sampled") / TICK_S
    assert (
        growth_rate_sampled(formation, int(ticks), 300.0) < 0.0 < growth_rate_sampled(formation, int(ticks) + 1, 300.0)
    )
