"""The paper's hybrid to the letter: rising inertia (40), (47) as printed, (48) without a choice."""

import numpy as np

from planner.search.cauchy import map_mutants, printed_landmark_mutants
from planner.search.objective import FloatArray, Objective
from planner.search.swarm import INERTIA_FIRST, INERTIA_LAST, first_swarm, velocities


def published(objective: Objective, starts: FloatArray, rng: np.random.Generator) -> None:
    """Steps 1-8 of the paper as printed; three evaluations a particle an iteration.

    The paper limits no velocity, and keeps the better only of the map operator's two places (45).
    """
    swarm = first_swarm(objective, starts, rng)
    while True:
        swarm.velocities = velocities(swarm, printed_inertia(objective.progress), rng)
        swarm.go(swarm.positions + swarm.velocities, objective)
        swarm.go_where_better(map_mutants(swarm, rng.random((len(swarm.positions), 1))), objective)
        swarm.go(printed_landmark_mutants(swarm, rng.random((len(swarm.positions), 1))), objective)


def printed_inertia(progress: float) -> float:
    """w of (40) as printed, (w_max - w_min) t / T: it rises from 0."""
    return (INERTIA_FIRST - INERTIA_LAST) * progress
