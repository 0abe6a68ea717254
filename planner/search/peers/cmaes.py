"""CMA-ES by its author's library, cma, with restarts in growing populations (IPOP)."""

import numpy as np

from planner.search.objective import FloatArray, Objective
from planner.search.peers.extra import LARGEST, extra

STEP = 0.25
"""First standard deviation, in widths of the box; the library's advice is a quarter."""
GROWTH = 2
"""Of the population from restart to restart: Auger and Hansen (2005)."""


def cmaes(objective: Objective, starts: FloatArray, rng: np.random.Generator) -> None:
    """From the best of the starts, or the middle of the box; then from random points, until the budget is used."""
    cma = extra("cma", "cmaes")
    mean = 0.5 * (objective.low + objective.high)
    if len(starts):
        mean = starts[int(np.argmin(objective(starts)))]
    grown = 1
    while True:
        strategy = cma.CMAEvolutionStrategy(
            mean,
            STEP,
            {
                "CMA_stds": objective.high - objective.low,
                "bounds": [objective.low, objective.high],
                "popsize_factor": grown,
                "randn": lambda *shape: rng.standard_normal(shape),
                "seed": np.nan,  # leave numpy's global generator alone
                "verbose": -9,
            },
        )
        while not strategy.stop():
            points = strategy.ask()
            strategy.tell(points, np.minimum(objective(np.array(points)), LARGEST))
        mean = objective.random(1, rng)[0]
        grown *= GROWTH
