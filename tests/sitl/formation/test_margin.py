"""The delay margin: the figures of MODEL section 6, who limits it, and where there is none.

Simulations on both sides of it are in tests/gcs/bench/test_margins.py.
"""

import math

import numpy as np
import pytest

from missions.scenario import load_scenario
from sitl.formation.continuous_margin import continuous_margin
from sitl.formation.graph import edges, laplacian
from sitl.formation.law import Gains
from sitl.formation.linear_formation import LinearFormation, Mode
from sitl.formation.margin import Level, aircraft_margin_s, limiting_mode, margin_s, mode_margins

NINE = range(1, 10)
AIRFRAME = load_scenario("radars").airframe.airframe()
FLOWN = Gains(0.2, 0.8, 0.4, 0.01)
ALL, ONE = np.ones(9), np.eye(9)[0]
LEVELS: tuple[Level, ...] = ("continuous", "sampled", "aircraft")


def bare(kind: str, pinned: np.ndarray = ALL) -> LinearFormation:
    matrix = laplacian(NINE, edges(kind, NINE), unit_weights=True)
    return LinearFormation(matrix, Gains(0.2, 1.0, 1.0, 0.0), pinned, bare=True)


def flown(kind: str, gains: Gains = FLOWN, pinned: np.ndarray = ALL) -> LinearFormation:
    return LinearFormation(laplacian(NINE, edges(kind, NINE)), gains, pinned)


def margins(formation: LinearFormation) -> list[float]:
    found = mode_margins(formation, AIRFRAME)
    return [margin_s(found, level) for level in LEVELS]


@pytest.mark.parametrize(("kind", "margin", "hold"), [("ring", 0.4736, 0.063), ("complete", 0.1855, 0.134)])
def test_the_figures_of_the_model(kind: str, margin: float, hold: float) -> None:
    continuous, sampled, _ = margins(bare(kind))
    assert continuous == pytest.approx(margin, abs=5e-5)
    assert sampled == pytest.approx(margin * (1 - hold), rel=0.002)


def test_the_margin_of_the_law_that_is_flown() -> None:
    continuous, _, aircraft = margins(flown("ring"))
    assert continuous == pytest.approx(1.0907, abs=1e-4)
    assert aircraft == pytest.approx(0.698, abs=0.001)
    assert aircraft_margin_s(flown("ring"), AIRFRAME) == aircraft


@pytest.mark.parametrize(
    "formation",
    [
        LinearFormation(np.zeros((1, 1)), FLOWN, np.ones(1)),
        flown("ring", Gains(0.0, 0.0, 0.4, 0.01)),
        flown("ring", Gains(0.0, 0.0, 0.4, 0.01), ONE),
        flown("ring", Gains(0.01, 0.1, 1.0, 0.1)),
    ],
    ids=["alone", "deaf", "deaf, pin one", "pins stronger than what is heard"],
)
def test_no_delay_matters(formation: LinearFormation) -> None:
    found = mode_margins(formation, AIRFRAME)
    for level in LEVELS:
        assert margin_s(found, level) == math.inf
        assert limiting_mode(found, level) is None
    assert aircraft_margin_s(formation, AIRFRAME) == math.inf


def test_a_formation_that_is_unstable_without_delay_has_no_room() -> None:
    continuous, sampled, aircraft = margins(flown("ring", Gains(0.2, 0.0, 0.0, 0.0)))
    assert (continuous, sampled, aircraft) == (0.0, 0.0, 0.0)


def test_the_whole_matrix_and_its_modes_have_one_margin() -> None:
    """The closed form against the sweep over the whole matrix, which vehicles with unlike pins need."""
    for formation in (flown("line", FLOWN._replace(k0=0.1)), bare("star")):
        whole = Mode(formation.laplacian, formation.damping(), formation.pins(), None, np.eye(9))
        found = continuous_margin(whole, formation.gains).delay_s
        assert found == pytest.approx(margins(formation)[0], rel=1e-6)


def test_who_swings() -> None:
    star = limiting_mode(mode_margins(bare("star"), AIRFRAME), "continuous")
    assert star is not None
    assert star.mode.eigenvalue == pytest.approx(9.0)
    assert star.swing("continuous") == pytest.approx([8 / 9] + [1 / 72] * 8), "its hub against all others"
    ring = limiting_mode(mode_margins(flown("ring"), AIRFRAME), "aircraft")
    assert ring is not None
    assert ring.mode.multiplicity == 2
    assert ring.swing("aircraft") == pytest.approx(np.full(9, 1 / 9)), "two modes that differ by who is where"
    pinned = limiting_mode(mode_margins(bare("ring", ONE), AIRFRAME), "continuous")
    assert pinned is not None
    assert pinned.mode.eigenvalue is None
    assert pinned.swing("continuous").sum() == pytest.approx(1.0)
    assert pinned.swing("continuous").argmin() == 0, "whom its own speed holds"
