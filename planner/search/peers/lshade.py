"""L-SHADE, Tanabe and Fukunaga (2014), by the library minionpy."""

import numpy as np

from planner.search.objective import FloatArray, Objective
from planner.search.peers.extra import extra

POPULATION = 5
"""First members a number. The authors' 18 are for 10 000 evaluations a number; 5, which the library's documentation
names, do better at 200 and as well at 2000 on paths."""


def lshade(objective: Objective, starts: FloatArray, rng: np.random.Generator) -> None:
    """The library's parameters but for the first population, which shrinks until the budget is used."""
    minionpy = extra("minionpy", "lshade")
    raised: list[BaseException] = []

    def fun(points: list[list[float]]) -> list[float]:
        """No exception may pass through the library, which is compiled: it is kept and raised again outside."""
        if raised:
            return [np.inf] * len(points)
        try:
            return objective(np.array(points)).tolist()  # type: ignore[no-any-return]
        except BaseException as error:
            raised.append(error)
            return [np.inf] * len(points)

    while not raised:
        minionpy.LSHADE(
            fun,
            bounds=list(zip(objective.low.tolist(), objective.high.tolist(), strict=True)),
            x0=starts.tolist() or None,
            maxevals=objective.left,
            callback=lambda _: bool(raised),
            seed=int(rng.integers(2**31)),
            options={"population_size": max(POPULATION * objective.dimension, len(starts))},
        ).optimize()
    raise raised[0]
