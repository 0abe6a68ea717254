"""The paper's Cauchy mutants, equations (43)-(48)."""

import numpy as np

from planner.search.objective import FloatArray
from planner.search.swarm import Swarm


def map_mutants(swarm: Swarm, chance: FloatArray) -> FloatArray:
    """(n, d) by (43)-(44): away from the best or towards it, by a Cauchy number a particle.

    Args:
        swarm: as it is now.
        chance: (n, 1) uniform in [0, 1).
    """
    c1 = np.tan(np.pi * (chance - 0.5))
    return swarm.positions + c1 * (swarm.positions - swarm.best)


def landmark_mutants(swarm: Swarm, chance: FloatArray) -> FloatArray:
    """(n, d) by (46)-(48): towards the best or past it, by a half Cauchy number a particle, c2 as (46) has it."""
    return towards_best(swarm, np.tan(0.5 * np.pi * chance))


def printed_landmark_mutants(swarm: Swarm, chance: FloatArray) -> FloatArray:
    """The same with c2 as (47) prints it, tan(2 / pi rand): never more than 0.74 of the way."""
    return towards_best(swarm, np.tan(2.0 / np.pi * chance))


def towards_best(swarm: Swarm, c2: FloatArray) -> FloatArray:
    """Equation (48)."""
    return swarm.positions + c2 * (swarm.best - swarm.positions)
