"""Quantum-behaved particle swarm optimisation: Sun, Feng and Xu (2004), with the mean best position of Sun, Xu and Feng
of the same year."""

import numpy as np

from planner.search.objective import FloatArray, Objective
from planner.search.swarm import Swarm, first_swarm

CONTRACTION_FIRST, CONTRACTION_LAST = 1.0, 0.5
"""The contraction-expansion coefficient at the beginning and the end; the authors' values."""


def qpso(objective: Objective, starts: FloatArray, rng: np.random.Generator) -> None:
    """Quantum-behaved particle swarm; one evaluation a particle an iteration."""
    swarm = first_swarm(objective, starts, rng)
    while True:
        contraction = CONTRACTION_FIRST - (CONTRACTION_FIRST - CONTRACTION_LAST) * objective.progress
        between, depth, side = rng.random((3, *swarm.positions.shape))
        swarm.go(quantum_positions(swarm, contraction, between, depth, side), objective)


def quantum_positions(
    swarm: Swarm, contraction: float, between: FloatArray, depth: FloatArray, side: FloatArray
) -> FloatArray:
    """Where particles are seen next.

    x = p +- contraction |m - x| ln(1 / u): p lies between a particle's own best and the best of all, m is the mean of
    all own bests.

    Args:
        swarm: as it is now.
        contraction: the coefficient.
        between, depth, side: (n, d) uniform in [0, 1): where p lies, 1 - u, and + from 0.5.
    """
    attractor = between * swarm.own_best + (1.0 - between) * swarm.best
    spread = contraction * np.abs(swarm.own_best.mean(axis=0) - swarm.positions)
    seen: FloatArray = attractor - np.where(side < 0.5, 1.0, -1.0) * spread * -np.log1p(-depth)
    return seen
