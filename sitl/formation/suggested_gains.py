"""Gains that damp a formation of aircraft as well as can be at a delay."""

import math
from dataclasses import replace

import numpy as np
import numpy.typing as npt
from scipy.optimize import differential_evolution, minimize

from missions.airframe import Airframe
from sitl.formation.damping import decay_rate
from sitl.formation.law import Gains
from sitl.formation.linear_formation import LinearFormation, evenly_pinned, modes
from sitl.formation.plant import aircraft_rates
from sitl.ticks import TICK_S

K1_RANGE, K2_RANGE = (1e-6, 2.0), (1e-3, 4.0)
MODES_SEARCHED = 8
"""Of a large formation, spread over its eigenvalues: the slowest is near an end of them."""
POPULATION, GENERATIONS, REFINEMENTS = 8, 40, 3
SIMPLEX = 0.2
"""Edge of a refinement's first simplex, in logarithms of gains."""


def suggested_gains(formation: LinearFormation, airframe: Airframe, delay_s: float) -> Gains:
    """k1, k2 and k3 at which the slowest mode that moves aircraft against each other decays fastest; k0 is kept.

    Where not all are pinned, the formation counts as pinned by the mean h_p: what vehicles feel who move together.

    k3 is at least critical for the pin, 2 sqrt(k0), so that the whole comes back to its schedule without swinging, and
    at most half the inverse of thrust lag and tick, where the own loop is damped by 0.7. The search is the same one
    each time: differential evolution from one seed, then simplex searches from the best.
    """
    whole = evenly_pinned(formation)
    rates = aircraft_rates(airframe)
    highest = 0.5 / (airframe.thrust_lag_s + TICK_S)
    lowest = min(max(2.0 * math.sqrt(whole.gains.k0), 0.05 * highest), 0.9 * highest)
    bounds = np.log(np.array([K1_RANGE, K2_RANGE, (lowest, highest)]))

    chosen = modes(whole)
    if len(chosen) > MODES_SEARCHED:
        chosen = [chosen[i] for i in np.linspace(0, len(chosen) - 1, MODES_SEARCHED).round().astype(int)]

    def growth(logs: npt.NDArray[np.float64]) -> float:
        gains = _gains(logs, whole.gains.k0)
        damping = replace(whole, gains=gains).damping()[:1]
        return -decay_rate([replace(mode, damping=damping) for mode in chosen], gains, rates, delay_s)

    best = differential_evolution(
        growth, bounds, rng=1, popsize=POPULATION, maxiter=GENERATIONS, tol=0.0, polish=False, init="sobol"
    ).x
    for i in range(REFINEMENTS):
        edge = SIMPLEX * (-0.5) ** i
        simplex = np.clip(np.vstack([best, best + edge * np.eye(3)]), bounds[:, 0], bounds[:, 1])
        best = minimize(growth, best, method="Nelder-Mead", bounds=bounds, options={"initial_simplex": simplex}).x
    found = _gains(best, whole.gains.k0)
    return found if whole.damping().any() else found._replace(k3=whole.gains.k3)


def _gains(logs: npt.NDArray[np.float64], k0: float) -> Gains:
    """Three significant digits, for a scenario file."""
    k1, k2, k3 = (float(f"{gain:.3g}") for gain in np.exp(logs))
    return Gains(k1, k2, k3, k0)
