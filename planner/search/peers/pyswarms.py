"""Particle swarm optimisation by the library pyswarms."""

import logging.config
from collections.abc import Iterator
from contextlib import contextmanager

import numpy as np

from planner.search.objective import FloatArray, Objective
from planner.search.peers.extra import LARGEST, extra

POPULATION = 40
"""Particles where there are not more starts."""
OPTIONS = {"c1": 1.49618, "c2": 1.49618, "w": 0.7298}
"""Clerc's constriction, Eberhart and Shi (2000)."""


def pyswarms(objective: Objective, starts: FloatArray, rng: np.random.Generator) -> None:
    """The library's swarm with one best of all; what leaves the box is put back on its wall."""
    others = objective.random(max(0, POPULATION - len(starts)), rng)
    positions = np.concatenate([starts, others])
    with _guarded(int(rng.integers(2**32))):
        swarm = extra("pyswarms.single", "pyswarms").GlobalBestPSO(
            len(positions),
            objective.dimension,
            OPTIONS,
            bounds=(objective.low, objective.high),
            bh_strategy="nearest",
            init_pos=positions,
        )
        swarm.optimize(
            lambda points: np.minimum(objective(points), LARGEST),
            iters=objective.budget,
            verbose=False,
        )


@contextmanager
def _guarded(seed: int) -> Iterator[None]:
    """The library knows only numpy's global generator, which is lent to it and put back as it was; and it would set up
    the program's logging anew, with a file in the current folder."""
    state, configure = np.random.get_state(), logging.config.dictConfig
    np.random.seed(seed)
    logging.config.dictConfig = lambda config: None
    try:
        yield
    finally:
        np.random.set_state(state)
        logging.config.dictConfig = configure
