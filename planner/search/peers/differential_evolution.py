"""Differential evolution by scipy."""

import numpy as np
from scipy import optimize

from planner.search.objective import FloatArray, Objective

POPULATION = 50
"""Members where there are not more starts. scipy's default of 15 d is for few dimensions."""


def differential_evolution(objective: Objective, starts: FloatArray, rng: np.random.Generator) -> None:
    """scipy's strategy and coefficients, without its gradient polish and without its test of convergence."""
    others = objective.random(max(0, POPULATION - len(starts)), rng)
    optimize.differential_evolution(
        lambda columns: objective(columns.T),  # type: ignore[misc, arg-type]  # the stubs know nothing of `vectorized`
        optimize.Bounds(objective.low, objective.high),
        init=np.concatenate([starts, others]),
        maxiter=objective.budget,
        tol=0.0,
        atol=-1.0,
        polish=False,
        updating="deferred",
        vectorized=True,
        rng=rng,
    )
