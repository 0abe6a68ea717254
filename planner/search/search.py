"""What every search takes and gives: a cost of a population, a budget in evaluations, a random generator."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.float64]

Cost = Callable[[FloatArray], FloatArray]
"""(n, d) to (n,), lower is better."""
Report = Callable[[int, int, float], None]
"""Called after each iteration with its number from 1, how many there will be, and the best cost so far."""


@dataclass(frozen=True)
class SearchResult:
    """What a search found.

    Attributes:
        best: (d,).
        cost: of `best`.
        history: best cost after each iteration.
        evaluations: of the cost function, never more than the budget.
    """

    best: FloatArray
    cost: float
    history: tuple[float, ...]
    evaluations: int


class Search(Protocol):
    """A search for the least cost within a box.

    Args:
        cost: of a whole population at once.
        swarm: (n, d) population to begin with.
        low, high: (d,) corners of the box; what leaves it is put back on its wall.
        budget: evaluations at most, at least n.
        rng: the only source of chance.
        report: told of every iteration.
    """

    def __call__(
        self,
        cost: Cost,
        swarm: FloatArray,
        low: FloatArray,
        high: FloatArray,
        *,
        budget: int,
        rng: np.random.Generator,
        report: Report,
    ) -> SearchResult: ...
