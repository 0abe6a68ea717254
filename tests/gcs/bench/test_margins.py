"""Delay margins hold in simulations in time, which share no mathematics with them."""

import numpy as np
import pytest

from gcs.bench.margins import simulated_growth, studies, time_steps
from missions.scenario import load_scenario
from sitl.formation.margin import Level, margin_s, mode_margins


@pytest.mark.parametrize("level", ["continuous", "sampled"])
def test_formations_settle_3_percent_below_their_margins_and_ring_3_percent_above(level: Level) -> None:
    """On five graphs, pinned and not; continuous time is stepped by a two hundredth of the margin."""
    airframe = load_scenario("radars").airframe.airframe()
    cases = studies()
    margins_s = np.array([margin_s(mode_margins(formation, airframe), level) for formation in cases.values()])
    count = 16_000 if level == "continuous" else 8_000
    delays_s = np.outer(margins_s, [0.97, 1.03])
    below, above = simulated_growth(list(cases.values()), time_steps(margins_s, level), delays_s, count).T
    assert (below < 0.0).all(), dict(zip(cases, below, strict=True))
    assert (above > 0.0).all(), dict(zip(cases, above, strict=True))
