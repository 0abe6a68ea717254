"""Particle swarm optimisation, equations (32)-(40)."""

import numpy as np

from planner.search.objective import FloatArray, Objective
from planner.search.swarm import first_swarm, fly


def pso(objective: Objective, starts: FloatArray, rng: np.random.Generator) -> None:
    """Particle swarm with falling inertia; one evaluation a particle an iteration."""
    swarm = first_swarm(objective, starts, rng)
    while True:
        fly(swarm, objective, rng)
