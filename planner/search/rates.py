"""How fast an evolution learns: the defaults in appendix A of Hansen's tutorial (arXiv 1604.00772)."""

import math
from typing import NamedTuple

import numpy as np

from planner.search.objective import FloatArray


class Rates(NamedTuple):
    """Constants of one evolution.

    Attributes:
        weights: (n,) of the points of a generation, from the best to the worst; the better half sum up to 1.
        effective: how many points of equal weight the better half are worth.
        path, step: of the two paths.
        damping: of the step.
        rank_one, rank_many: of the covariance, from its path and from the points.
    """

    weights: FloatArray
    effective: float
    path: float
    step: float
    damping: float
    rank_one: float
    rank_many: float


def population(dimension: int) -> int:
    """Points a generation."""
    return 4 + int(3.0 * math.log(dimension))


def rates(dimension: int, points: int) -> Rates:
    """Constants for so many numbers and points a generation, at least 4."""
    d, parents = dimension, points // 2
    raw = math.log((points + 1) / 2) - np.log(np.arange(1, points + 1))
    weights = raw / raw[:parents].sum()
    better, worse = weights[:parents], weights[parents:]
    effective = 1.0 / float(np.sum(better**2))
    effective_worse = float(worse.sum() ** 2 / np.sum(worse**2))
    step = (effective + 2) / (d + effective + 5)
    rank_one = 2 / ((d + 1.3) ** 2 + effective)
    rank_many = min(1 - rank_one, 2 * (effective - 1.75 + 1 / effective) / ((d + 2) ** 2 + effective))
    worse *= min(  # the last keeps the covariance positive
        1 + rank_one / rank_many,
        1 + 2 * effective_worse / (effective + 2),
        (1 - rank_one - rank_many) / (d * rank_many),
    ) / float(np.abs(worse).sum())
    return Rates(
        weights=weights,
        effective=effective,
        path=(4 + effective / d) / (d + 4 + 2 * effective / d),
        step=step,
        damping=1 + 2 * max(0.0, math.sqrt((effective - 1) / (d + 1)) - 1) + step,
        rank_one=rank_one,
        rank_many=rank_many,
    )
