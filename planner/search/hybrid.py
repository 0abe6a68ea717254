"""The paper's hybrid: a particle swarm with Cauchy mutants, equations (39)-(48), corrected as MODEL, section 4 says."""

import numpy as np

from planner.search.cauchy import landmark_mutants, map_mutants
from planner.search.objective import FloatArray, Objective
from planner.search.swarm import first_swarm, fly


def hybrid(objective: Objective, starts: FloatArray, rng: np.random.Generator) -> None:
    """Steps 1-8 of the paper: each iteration moves every particle by (39), then tries the map operator (44) and the
    landmark operator (48) on it and keeps what is better; three evaluations a particle an iteration."""
    swarm = first_swarm(objective, starts, rng)
    while True:
        fly(swarm, objective, rng)
        swarm.go_where_better(map_mutants(swarm, rng.random((len(swarm.positions), 1))), objective)
        swarm.go_where_better(landmark_mutants(swarm, rng.random((len(swarm.positions), 1))), objective)
