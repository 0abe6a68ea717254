"""The delay margin: the closed form, the figures of MODEL section 6, and a simulation on both sides of it."""

import math

import numpy as np
import pytest

from sitl.formation.graph import edges, laplacian
from sitl.formation.law import Gains
from sitl.formation.margin import aircraft_margin_s, continuous_margin_s

NINE = list(range(1, 10))
UNPINNED = Gains(0.2, 1.0, 1.0, 0.0)
FLOWN = Gains(0.2, 0.8, 0.4, 0.01)


def unit_laplacian(kind: str) -> np.ndarray:
    matrix = np.zeros((9, 9))
    for p, q in edges(kind, NINE):
        matrix[[p - 1, q - 1], [q - 1, p - 1]] -= 1
        matrix[[p - 1, q - 1], [p - 1, q - 1]] += 1
    return matrix


def continuous(matrix: np.ndarray, gains: Gains) -> float:
    return min(continuous_margin_s(mode, gains) for mode in np.linalg.eigvalsh(matrix) if mode > 1e-9)


@pytest.mark.parametrize(("kind", "margin", "hold"), [("ring", 0.4736, 0.06), ("complete", 0.1855, 0.13)])
def test_the_figures_of_the_model(kind: str, margin: float, hold: float) -> None:
    matrix = unit_laplacian(kind)
    assert continuous(matrix, UNPINNED) == pytest.approx(margin, abs=5e-5)
    assert aircraft_margin_s(matrix, UNPINNED, 0.0, 0.04) == pytest.approx(margin * (1 - hold), rel=0.01)
    assert aircraft_margin_s(matrix, UNPINNED, 0.0, margin / 200) == pytest.approx(margin, rel=0.01)


def test_the_margin_of_the_law_that_is_flown() -> None:
    matrix = laplacian(NINE, edges("ring", NINE))
    assert continuous(matrix, FLOWN) == pytest.approx(1.09, abs=0.005)
    assert aircraft_margin_s(matrix, FLOWN, 0.5, 0.04) == pytest.approx(0.65, abs=0.005)


def test_without_neighbours_no_delay_matters() -> None:
    assert aircraft_margin_s(np.zeros((1, 1)), FLOWN, 0.5, 0.04) == math.inf


@pytest.mark.parametrize("kind", ["ring", "complete", "star", "line"])
def test_disturbances_die_out_below_the_margin_and_grow_above_it(kind: str) -> None:
    matrix, tick = laplacian(NINE, edges(kind, NINE)), 0.04
    margin = aircraft_margin_s(matrix, FLOWN, 0.5, tick)
    below, above = math.floor(margin / tick), math.ceil(margin / tick) + 1
    assert amplitude_ratio(matrix, FLOWN, below, tick) < 1 < amplitude_ratio(matrix, FLOWN, above, tick)


def amplitude_ratio(matrix: np.ndarray, gains: Gains, delay: int, tick: float) -> float:
    """Late over early amplitude of a linear formation with thrust lag, simulated tick by tick."""
    e, rate, push = np.sin(np.arange(9.0) ** 2), np.zeros(9), np.zeros(9)
    history, sizes = [(e, rate)] * (delay + 1), []
    decay = math.exp(-tick / 0.5)
    for _ in range(20_000):
        history = [*history[1:], (e, rate)]
        then_e, then_rate = history[0]
        wanted = -matrix @ (gains.k1 * then_e + gains.k2 * then_rate) - gains.k3 * rate - gains.k0 * e
        # Exact over a tick: the push goes from its present value to the wanted one with a lag of 0.5 s.
        gap = push - wanted
        e = e + tick * rate + 0.5 * tick**2 * wanted + gap * (0.5 * tick - 0.25 * (1 - decay))
        rate = rate + tick * wanted + gap * 0.5 * (1 - decay)
        push = wanted + gap * decay
        sizes.append(np.abs(e - e.mean()).max())
    return float(max(sizes[-2000:]) / max(sizes[4000:6000]))
