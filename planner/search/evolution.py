"""Evolution of a normal distribution by covariance matrix adaptation (CMA-ES): Hansen's tutorial (2016), with negative
weights; numbers in square brackets are the tutorial's equations."""

import math
from typing import Any

import numpy as np

from planner.compiled import jit
from planner.search.objective import FloatArray, Objective

STILL = 1e-10
"""Of the box: a distribution narrower than this has nothing left to find."""
FLAT = 1e-9
"""So little change, relative to the best cost, is none."""
ROUND = 1e14
"""Largest ratio of the covariance's eigenvalues that arithmetic bears."""


def population(dimension: int) -> int:
    """Points a generation [48]."""
    return 4 + int(3.0 * math.log(dimension))


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
        parents = points // 2
        raw = math.log((points + 1) / 2) - np.log(np.arange(1, points + 1))  # [49]
        self._weights = raw / raw[:parents].sum()
        effective = 1.0 / float(np.sum(self._weights[:parents] ** 2))  # [8]
        negative = self._weights[parents:]
        self._effective = effective
        self._path_rate = (4 + effective / d) / (d + 4 + 2 * effective / d)  # [56]
        self._step_rate = (effective + 2) / (d + effective + 5)  # [55]
        self._damping = 1 + 2 * max(0.0, math.sqrt((effective - 1) / (d + 1)) - 1) + self._step_rate
        self._rank_one = 2 / ((d + 1.3) ** 2 + effective)  # [57]
        self._rank_many = min(
            1 - self._rank_one, 2 * (effective - 1.75 + 1 / effective) / ((d + 2) ** 2 + effective)
        )  # [58]
        negative_effective = float(negative.sum() ** 2 / np.sum(negative**2))
        negative *= min(  # [50]-[53]
            1 + self._rank_one / self._rank_many,
            1 + 2 * negative_effective / (effective + 2),
            (1 - self._rank_one - self._rank_many) / (d * self._rank_many),
        ) / float(np.abs(negative).sum())
        self._mean, self._step = mean.copy(), step
        self._paths = np.zeros((2, d))
        self._covariance = np.eye(d)
        self._root = self._inverse_root = np.eye(d)
        self._roots_last = max(1, round(1 / (d * (self._rank_one + self._rank_many))))
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
        steps = rng.standard_normal((len(self._weights), len(self._mean))) @ self._root
        inside = folded(self._mean + self._step * steps)
        costs = objective(objective.low + (objective.high - objective.low) * inside)
        order = np.argsort(costs, kind="stable")
        if costs[order[0]] < self.cost:
            self.best, self.cost = inside[order[0]], float(costs[order[0]])
        self._bests.append(float(costs[order[0]]))
        self._generation += 1
        self._step = _adapt(
            steps[order],
            self._weights,
            self._effective,
            self._path_rate,
            self._step_rate,
            self._damping,
            self._rank_one,
            self._rank_many,
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
        lengths = np.sqrt(np.maximum(values, 1e-30))
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
    weights: Any,
    effective: float,
    path_rate: float,
    step_rate: float,
    damping: float,
    rank_one: float,
    rank_many: float,
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
        middle += weights[i] * steps[i]
    mean += step * middle  # [42]
    paths[1] = (1 - step_rate) * paths[1] + math.sqrt(step_rate * (2 - step_rate) * effective) * (
        inverse_root @ middle
    )  # [43]
    length = math.sqrt(np.sum(paths[1] * paths[1]))
    expected = math.sqrt(d) * (1 - 1 / (4 * d) + 1 / (21 * d * d))
    unbiased = length / math.sqrt(1 - (1 - step_rate) ** (2 * generation))
    calm = 1.0 if unbiased < (1.4 + 2 / (d + 1)) * expected else 0.0
    paths[0] = (1 - path_rate) * paths[0] + calm * math.sqrt(path_rate * (2 - path_rate) * effective) * middle  # [45]
    kept = 1 - rank_one - rank_many * np.sum(weights) + rank_one * (1 - calm) * path_rate * (2 - path_rate)
    covariance *= kept  # [47]
    for i in range(-1, n):
        vector, factor = paths[0], rank_one
        if i >= 0:
            vector, factor = steps[i], rank_many * weights[i]
        if factor < 0:  # [46]
            whitened = inverse_root @ vector
            factor *= d / max(np.sum(whitened * whitened), 1e-30)
        for j in range(d):
            scaled = factor * vector[j]
            for k in range(d):
                covariance[j, k] += scaled * vector[k]
    return step * math.exp(min(1.0, step_rate / damping * (length / expected - 1)))  # [44]
