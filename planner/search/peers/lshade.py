"""L-SHADE, Tanabe and Fukunaga (2014), by the library minionpy."""

import numpy as np

from planner.search.objective import FloatArray, Objective
from planner.search.peers.extra import extra


def lshade(objective: Objective, starts: FloatArray, rng: np.random.Generator) -> None:
    """The library's parameters; its population shrinks until the budget is used."""
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
        ).optimize()
    raise raised[0]
