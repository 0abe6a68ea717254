"""Descent from one path to the best near it: quasi-Newton steps on the merit, multipliers in between."""

import math
from typing import Any

import numpy as np

from missions.compiled import jit
from planner.cost.kernel import path_cost
from planner.skein.merit import KM, merit

ARMIJO, CURVATURE = 1e-4, 0.5
"""Weak Wolfe conditions."""
BISECTIONS = 25
LONGEST_STEP_KM = 1.5
"""No waypoint moves further in one step."""
GROWTH, STIFFEST = 2.0, 1e4
"""Of the weight of the squares, from round to round and at most, 1 / km."""
HARDEST_M = 2.0
"""The least softness of (6): an error of some metres in kilometres of clearance."""
GRADIENT = 2
"""Evaluations that a merit with its gradient and its step counts as: it takes 1.6 to 2.2 times as long as one."""


@jit
def descend(
    corners: Any,
    problem: Any,
    crossed: Any,
    multipliers: Any,
    rho: float,
    soft_m: float,
    steps: int,
    most: int,
    tolerance_km: float,
    hessian: Any,
) -> int:
    """BFGS on the merit of one path's interior corners; returns how many gradients it took.

    BFGS with a weak Wolfe search also gets along the kinks that least distances have (Lewis and Overton 2013).

    Args:
        corners: (n + 1, 3) path in metres, moved.
        crossed, multipliers, rho, soft_m: of the merit.
        steps, most: so many, and so many gradients, at most.
        tolerance_km: ends when three steps together gain less.
        hessian: (d, d) inverse Hessian to begin with, km; refined.
    """
    count = len(corners) - 2
    d = 3 * count
    limits = np.empty(len(multipliers))
    slopes = np.empty_like(corners)
    value = merit(corners, problem, crossed, multipliers, rho, soft_m, limits, slopes)
    evaluations = 1
    trial, trial_slopes = corners.copy(), np.empty_like(corners)
    gradient, direction = np.empty(d), np.empty(d)
    moved, bent = np.empty(d), np.empty(d)
    gained = np.full(3, math.inf)
    for step in range(steps):
        if evaluations >= most:
            break
        for i in range(d):
            gradient[i] = slopes[1 + i // 3, i % 3]
        slope = 0.0
        for _ in range(2):
            slope = 0.0
            for i in range(d):
                total = 0.0
                for j in range(d):
                    total -= hessian[i, j] * gradient[j]
                direction[i] = total
                slope += total * gradient[i]
            if slope < 0.0:
                break
            hessian[:] = 0.0
            for i in range(d):
                hessian[i, i] = 1.0
        longest = 0.0
        for k in range(count):
            x, y, z = direction[3 * k], direction[3 * k + 1], direction[3 * k + 2]
            longest = max(longest, math.sqrt(x * x + y * y + z * z))
        if longest == 0.0:
            break
        length = min(1.0, LONGEST_STEP_KM / longest)
        low, high = 0.0, math.inf
        found = value
        for _ in range(min(BISECTIONS, most - evaluations)):
            for i in range(d):
                trial[1 + i // 3, i % 3] = corners[1 + i // 3, i % 3] + length * direction[i] / KM
            found = merit(trial, problem, crossed, multipliers, rho, soft_m, limits, trial_slopes)
            evaluations += 1
            if not found <= value + ARMIJO * length * slope:
                high = length
            else:
                slope_there = 0.0
                for i in range(d):
                    slope_there += trial_slopes[1 + i // 3, i % 3] * direction[i]
                if slope_there >= CURVATURE * slope or length * longest >= LONGEST_STEP_KM:
                    break
                low = length
            length = 0.5 * (low + high) if high < math.inf else min(2.0 * length, LONGEST_STEP_KM / longest)
        if not found < value:
            break
        curvature = 0.0
        for i in range(d):
            moved[i] = length * direction[i]
            bent[i] = trial_slopes[1 + i // 3, i % 3] - gradient[i]
            curvature += moved[i] * bent[i]
        corners[:] = trial
        slopes[:] = trial_slopes
        gained[step % 3] = value - found
        value = found
        if curvature > 1e-12:
            _update(hessian, moved, bent, curvature, step == 0)
        if gained.sum() < tolerance_km:
            break
    return evaluations


@jit
def _update(hessian: Any, moved: Any, bent: Any, curvature: float, first: bool) -> None:
    """The BFGS update of an inverse Hessian."""
    d = len(moved)
    along = np.empty(d)
    bend = 0.0
    for i in range(d):
        total = 0.0
        for j in range(d):
            total += hessian[i, j] * bent[j]
        along[i] = total
        bend += total * bent[i]
    scale = (1.0 + bend / curvature) / curvature
    for i in range(d):
        for j in range(d):
            hessian[i, j] += scale * moved[i] * moved[j] - (along[i] * moved[j] + moved[i] * along[j]) / curvature


@jit
def polish(
    corners: Any,
    tightened: Any,
    problem: Any,
    crossed: Any,
    multipliers: Any,
    rho: float,
    soft_m: float,
    rounds: int,
    steps: int,
    tolerance_km: float,
    allowance: int,
    best: Any,
) -> tuple[float, float, int]:
    """Rounds of descent, with multipliers and weight updated after each.

    Args:
        corners, crossed, multipliers: as in `descend`; corners and multipliers are moved on.
        tightened: the problem that the descent sees.
        problem: the problem by which paths are judged.
        rho: weight to begin with; grows by `GROWTH` a round.
        soft_m: to begin with; halves each round, down to `HARDEST_M`.
        rounds, steps, tolerance_km: how long.
        allowance: evaluations at most.
        best: (n + 1, 3) set to the best path found.

    Returns:
        The exact cost of `best`, the weight after the last round, and how many evaluations that took, each gradient
        counted as `GRADIENT`.
    """
    hessian = np.eye(3 * (len(corners) - 2))
    limits = np.empty(len(multipliers))
    slopes = np.empty_like(corners)
    terms = np.empty(5)
    cost = math.inf
    gradients = judged = 0
    most = (allowance - rounds) // GRADIENT
    for _ in range(rounds):
        left = most - gradients - 1
        if left < 2:
            break
        gradients += 1 + descend(
            corners, tightened, crossed, multipliers, rho, soft_m, steps, left, tolerance_km, hessian
        )
        merit(corners, tightened, crossed, multipliers, rho, soft_m, limits, slopes)
        for i in range(len(multipliers)):
            multipliers[i] = max(0.0, multipliers[i] + rho * limits[i])
        rho = min(rho * GROWTH, STIFFEST)
        soft_m = max(HARDEST_M, 0.5 * soft_m)
        found = path_cost(corners, problem, True, terms)
        judged += 1
        if found < cost:
            cost = found
            best[:] = corners
    return cost, rho, GRADIENT * gradients + judged
