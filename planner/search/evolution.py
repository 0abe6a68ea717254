"""Evolution of a normal distribution by covariance matrix adaptation (CMA-ES), with negative weights, as in appendix A
of Hansen's tutorial (arXiv 1604.00772)."""

import math
from typing import Any

import numpy as np

from missions.compiled import jit
from planner.search.objective import FloatArray, Objective
from planner.search.rates import rates

STILL = 1e-10
"""Of the box: a distribution narrower than this has nothing left to find."""
FLAT = 1e-9
"""So little change, relative to the best cost, is none."""
ROUND = 1e14
"""Largest ratio of the covariance's eigenvalues that arithmetic bears."""
TINY = 1e-30
"""Keeps divisions by lengths from failing."""


class Evolution:
    """One distribution on its way. It lives in a box of sides 1; what leaves that is folded back at the walls.

    Args:
        mean: (d,) where it begins, each number from 0 to 1.
        step: first standard deviation, in sides of the box.
        points: a generation, at least 4.

    Attributes:
        best, cost: (d,) the best point so far and its cost.
        over: whether going on is of no use.
    """

    def __init__(self, mean: FloatArray, step: float, points: int) -> None:
        d = len(mean)
        self._rates = rates(d, points)
        self._mean, self._step = mean.copy(), step
        self._paths = np.zeros((2, d))
        self._covariance = np.eye(d)
        self._root = self._inverse_root = np.eye(d)
        self._roots_last = max(1, round(1 / (d * (self._rates.rank_one + self._rates.rank_many))))
        self._generation = 0
        self._bests: list[float] = []
        self._memory = 10 + 30 * d // points
        self.best, self.cost = mean, math.inf
        self.over = False

    def run(self, objective: Objective, rng: np.random.Generator, until: int | None = None) -> None:
        """Go on to the end, or until so many generations have been."""
        while not self.over and (until is None or self._generation < until):
            self._go(objective, rng)

    def _go(self, objective: Objective, rng: np.random.Generator) -> None:
        """Evaluate one generation and learn from it."""
        steps = rng.standard_normal((len(self._rates.weights), len(self._mean))) @ self._root
        inside = folded(self._mean + self._step * steps)
        costs = objective(objective.low + (objective.high - objective.low) * inside)
        order = np.argsort(costs, kind="stable")
        if costs[order[0]] < self.cost:
            self.best, self.cost = inside[order[0]], float(costs[order[0]])
        self._bests.append(float(costs[order[0]]))
        self._generation += 1
        self._step = _adapt(
            steps[order],
            self._rates,
            self._generation,
            self._step,
            self._inverse_root,
            self._mean,
            self._paths,
            self._covariance,
        )
        if self._generation % self._roots_last == 0:
            self._new_roots()

    def _new_roots(self) -> None:
        """Square root of the covariance and its inverse; whether all this is over."""
        values, axes = np.linalg.eigh(self._covariance)
        lengths = np.sqrt(np.maximum(values, TINY))
        self._root = (axes * lengths) @ axes.T
        self._inverse_root = (axes / lengths) @ axes.T
        last = self._bests[-self._memory :]
        self.over = (
            self._step * lengths[-1] < STILL
            or values[-1] > ROUND * values[0]
            or (len(last) == self._memory and not max(last) - min(last) > FLAT * abs(min(last)))
        )


def folded(points: FloatArray) -> FloatArray:
    """Points in the box of sides 1, those outside reflected at its walls as often as needed."""
    inside: FloatArray = np.abs(np.mod(points + 1.0, 2.0) - 1.0)
    return inside


@jit
def _adapt(
    steps: Any,
    rates: Any,
    generation: int,
    step: float,
    inverse_root: Any,
    mean: Any,
    paths: Any,
    covariance: Any,
) -> float:
    """Move mean, paths (of the covariance, of the step) and covariance, in place; returns the new step.

    `steps` are (n, d), the best first, in units of the old step.
    """
    n, d = steps.shape
    middle = np.zeros(d)
    for i in range(n // 2):
        middle += rates.weights[i] * steps[i]
    mean += step * middle
    long = math.sqrt(rates.step * (2 - rates.step) * rates.effective)
    paths[1] = (1 - rates.step) * paths[1] + long * (inverse_root @ middle)
    length = math.sqrt(np.sum(paths[1] * paths[1]))
    expected = math.sqrt(d) * (1 - 1 / (4 * d) + 1 / (21 * d * d))
    unbiased = length / math.sqrt(1 - (1 - rates.step) ** (2 * generation))
    calm = 1.0 if unbiased < (1.4 + 2 / (d + 1)) * expected else 0.0
    spread = rates.path * (2 - rates.path)
    paths[0] = (1 - rates.path) * paths[0] + calm * math.sqrt(spread * rates.effective) * middle
    covariance *= 1 - rates.rank_one * (1 - (1 - calm) * spread) - rates.rank_many * np.sum(rates.weights)
    for i in range(-1, n):
        vector, factor = paths[0], rates.rank_one
        if i >= 0:
            vector, factor = steps[i], rates.rank_many * rates.weights[i]
        if factor < 0:
            whitened = inverse_root @ vector
            factor *= d / max(np.sum(whitened * whitened), TINY)
        for j in range(d):
            scaled = factor * vector[j]
            for k in range(d):
                covariance[j, k] += scaled * vector[k]
    return float(step * math.exp(min(1.0, rates.step / rates.damping * (length / expected - 1))))
