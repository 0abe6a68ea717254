"""A cost function in a box with a budget: the one place where evaluations are counted."""

from collections.abc import Callable
from typing import Protocol

import numpy as np
import numpy.typing as npt
from scipy.optimize import OptimizeResult

from missions.errors import InputError

FloatArray = npt.NDArray[np.float64]
Fun = Callable[[FloatArray], FloatArray]
"""(n, d) to (n,), lower is better."""
Callback = Callable[[OptimizeResult], object]
"""Told after each batch the best `x` and `fun` so far, `nfev` and `nit`; StopIteration ends the search."""


class SearchEnded(Exception):  # noqa: N818  (nothing went wrong)
    """Raised out of a search when it may not evaluate any more."""


class BudgetSpent(SearchEnded):
    """All evaluations are used."""


class Stopped(SearchEnded):
    """The callback asked for the end."""


class Objective:
    """What a search sees: call it with (n, d) points to get (n,) costs, as long as there is budget.

    Whatever a search does, no more than `budget` points are evaluated, all of them in the box, and the best is kept:
    the batch that reaches the budget is cut to what is left and ends the search by `BudgetSpent`. Costs that are not
    a number count as infinite.

    Args:
        fun: the cost function.
        low, high: (d,) corners of the box.
        budget: evaluations at most, at least 1.
        callback: see `Callback`.

    Attributes:
        spent: evaluations so far.
        best, cost: (d,) the best point so far and its cost.
        history: evaluations and best cost after each batch.
    """

    def __init__(
        self, fun: Fun, low: FloatArray, high: FloatArray, budget: int, callback: Callback | None = None
    ) -> None:
        self.low, self.high, self.budget = low, high, budget
        self.spent = 0
        self.best, self.cost = low, np.inf
        self.history: list[tuple[int, float]] = []
        self._fun, self._callback = fun, callback

    @property
    def dimension(self) -> int:
        """d."""
        return len(self.low)

    @property
    def left(self) -> int:
        """Evaluations that may still be made."""
        return self.budget - self.spent

    @property
    def progress(self) -> float:
        """Part of the budget that is used, 0 to 1."""
        return self.spent / self.budget

    def random(self, points: int, rng: np.random.Generator) -> FloatArray:
        """(points, d) anywhere in the box."""
        return rng.uniform(self.low, self.high, (points, self.dimension))

    def __call__(self, points: FloatArray) -> FloatArray:
        """Costs of points, which are moved to the box's wall where they lie outside.

        Raises:
            SearchEnded: for the search to let through.
            InputError: the function does not return one cost a point.
        """
        inside = np.clip(points[: self.left], self.low, self.high)
        costs = np.array(self._fun(inside.copy()), dtype=np.float64)
        if costs.shape != (len(inside),):
            raise InputError(
                f"fun: must turn points of shape {inside.shape} into costs of shape ({len(inside)},), "
                f"but returned shape {costs.shape}"
            )
        costs[np.isnan(costs)] = np.inf
        leader = int(np.argmin(costs))
        if self.spent == 0 or costs[leader] < self.cost:
            self.best, self.cost = inside[leader].copy(), float(costs[leader])
        self.spent += len(inside)
        self.history.append((self.spent, self.cost))
        self._tell()
        if self.left == 0:
            raise BudgetSpent
        return costs

    def _tell(self) -> None:
        if self._callback is None:
            return
        now = OptimizeResult(  # type: ignore[call-arg]  # the stubs know no keywords
            x=self.best.copy(), fun=self.cost, nfev=self.spent, nit=len(self.history)
        )
        try:
            self._callback(now)
        except StopIteration:
            raise Stopped from None


class Search(Protocol):
    """A search for the least cost within a box. It need not end: the objective ends it.

    Args:
        objective: to evaluate points with.
        starts: (n, d) points to begin with, in the box; n may be 0.
        rng: the only source of chance.
    """

    def __call__(self, objective: Objective, starts: FloatArray, rng: np.random.Generator) -> None: ...
