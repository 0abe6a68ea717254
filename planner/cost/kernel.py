"""The objective (3)-(11) and the constraints (12) of many paths at once, over all cores."""

import math
from typing import Any, Literal

import numpy as np
import numpy.typing as npt

from missions.compiled import jit, parallel_jit, prange
from missions.environment import Terrain
from planner.cost.constraints import broken_limits
from planner.cost.leg_box import apart, leg_box
from planner.cost.obstacles import least_wall_distance_m
from planner.cost.problem import PathProblem
from planner.cost.radar import radar_integral_m
from planner.cost.separation import least_separation_m
from planner.cost.terrain import leg_clearance_m

FloatArray = npt.NDArray[np.float64]
Reading = Literal["graded", "published"]

TOUCH_M = 1e-6
"""Shortfalls below this are rounding: an origin stands on the ground, exactly as high as wanted."""
INFEASIBLE_KM = 1e9
"""Added to the cost of every infeasible path, so that it ranks after every feasible one."""


def evaluate(interiors: FloatArray, problem: PathProblem, reading: Reading) -> tuple[FloatArray, FloatArray]:
    """Cost and terms of paths given by their interior waypoints.

    Args:
        interiors: (n, d) interior waypoints, d = 3 m, metres.
        problem: what they must mind.
        reading: of the penalties (MODEL, section 3): `published` adds constants, `graded` lets them grow with the
            depth of each violation and the number of legs that have it. Equal for feasible paths.

    Returns:
        costs: (n,) f of (3) in kilometres; infeasible paths lie above `INFEASIBLE_KM`.
        terms: (n, 5) f_L, f_T, f_R, f_C, f_H in kilometres.

    The same for any number of threads.
    """
    costs, terms = np.empty(len(interiors)), np.empty((len(interiors), 5))
    ends, rest = problem[:2], problem[3:]
    _evaluate(np.ascontiguousarray(interiors), *ends, *problem.terrain, *rest, reading == "graded", costs, terms)
    return costs, terms


@parallel_jit
def _evaluate(
    interiors: Any,
    origin_m: Any,
    target_m: Any,
    base_m: Any,
    wave: Any,
    peaks: Any,
    posts: Any,
    x0_m: Any,
    y0_m: Any,
    spacing_x_m: Any,
    spacing_y_m: Any,
    tops: Any,
    radars: Any,
    obstacles: Any,
    others: Any,
    separations_m: Any,
    bounds: Any,
    graded: Any,
    costs: Any,
    terms: Any,
) -> None:
    """`evaluate` on single arguments: a parallel loop takes no tuple in a tuple, so it puts the problem together."""
    for i in prange(len(interiors)):
        terrain = Terrain(base_m, wave, peaks, posts, x0_m, y0_m, spacing_x_m, spacing_y_m, tops)
        problem = PathProblem(origin_m, target_m, terrain, radars, obstacles, others, separations_m, bounds)
        corners = np.empty((interiors.shape[1] // 3 + 2, 3))
        corners[0] = problem.origin_m
        corners[-1] = problem.target_m
        for k in range(1, len(corners) - 1):
            corners[k] = interiors[i, 3 * k - 3 : 3 * k]
        costs[i] = path_cost(corners, problem, graded, terms[i])


@jit
def path_cost(corners: Any, problem: Any, graded: Any, terms: Any) -> float:
    """f of one path of (n + 1, 3) corners (3), kilometres; fills in its five terms."""
    bounds, terrain, radars, obstacles = problem.bounds, problem.terrain, problem.radars, problem.obstacles
    legs = len(corners) - 1
    arcs = np.empty(legs)
    broken, excess = broken_limits(corners, bounds, arcs)
    passed = np.zeros(legs + 1)
    for k in range(legs):
        passed[k + 1] = passed[k] + arcs[k]

    length = radar = least_sum = depth = collision = 0.0
    underground = 0
    other_legs = np.zeros(len(problem.others), np.int64)
    for k in range(legs):
        p, q = corners[k], corners[k + 1]
        dx, dy, dz = q[0] - p[0], q[1] - p[1], q[2] - p[2]
        length += math.sqrt(dx * dx + dy * dy + dz * dz)

        least, _, shortfall, _ = leg_clearance_m(
            p, q, passed[k], passed[k + 1], terrain, bounds.clearance_m, bounds.climb_out_m
        )
        least_sum += least
        if least < -TOUCH_M:
            underground += 1
            depth -= least
        if shortfall > TOUCH_M:
            broken += 1
            excess += shortfall / 1000.0

        box = leg_box(p, q)
        for i in range(len(radars)):
            if not apart(box, radars[i, 0], radars[i, 1], radars[i, 3]):
                radar += radar_integral_m(p, q, radars[i])

        for i in range(len(obstacles)):
            if apart(box, obstacles[i, 0], obstacles[i, 1], obstacles[i, 2] + obstacles[i, 4]):
                continue
            missing = obstacles[i, 4] - least_wall_distance_m(p, q, obstacles[i])
            if missing > 0.0:
                collision += 1.0 + (missing / 1000.0 if graded else 0.0)

        start, end = passed[k] / passed[legs], passed[k + 1] / passed[legs]
        for i in range(len(problem.others)):
            distance, _, other_legs[i] = least_separation_m(p, q, start, end, problem.others[i], other_legs[i])
            missing = problem.separations_m[i] - distance
            if missing > 0.0:
                collision += 1.0 + (missing / 1000.0 if graded else 0.0)

    terms[0] = length / 1000.0
    if underground == 0:
        terms[1] = bounds.terrain_constant_km2 * legs / max(least_sum / 1000.0, 1e-9)
    else:
        terms[1] = bounds.terrain_penalty_km * (1.0 + (depth / 1000.0 if graded else 0.0))
    terms[2] = radar / 1000.0
    terms[3] = bounds.collision_penalty_km * collision
    terms[4] = _altitude_deviation_m(corners) / 1000.0
    f: float = terms[0] + terms[1] + terms[2] + terms[3] + terms[4]
    if broken == 0 and underground == 0 and collision == 0.0:
        return min(f, 0.5 * INFEASIBLE_KM)
    if graded:
        f += bounds.collision_penalty_km * (broken + excess)
    return INFEASIBLE_KM + f


@jit
def _altitude_deviation_m(corners: Any) -> float:
    """f_H of equation (11), which divides by the number of legs, in metres."""
    mean = 0.0
    for k in range(len(corners)):
        mean += corners[k, 2] / len(corners)
    squares = 0.0
    for k in range(len(corners)):
        squares += (corners[k, 2] - mean) * (corners[k, 2] - mean)
    return math.sqrt(squares / (len(corners) - 1))


@jit
def path_costs(paths_m: Any, problem: Any) -> Any:
    """`evaluate` of (n, m, 3) paths, graded, in the calling thread: costs (n,)."""
    costs, terms = np.empty(len(paths_m)), np.empty(5)
    for i in range(len(paths_m)):
        costs[i] = path_cost(paths_m[i], problem, True, terms)
    return costs
