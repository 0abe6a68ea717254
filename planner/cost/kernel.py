"""The objective (3)-(11) and the constraints (12) of many paths at once, over all cores."""

import math
from typing import Any, Literal

import numpy as np
import numpy.typing as npt

from missions.environment import Terrain
from planner.compiled import jit, parallel_jit, prange
from planner.cost.obstacles import least_wall_distance_m
from planner.cost.problem import PathProblem
from planner.cost.radar import radar_integral_m
from planner.cost.separation import least_separation_m
from planner.cost.terrain import leg_clearance_m

FloatArray = npt.NDArray[np.float64]
Reading = Literal["graded", "published"]

INFEASIBLE_KM = 1e9
"""Added to the cost of every infeasible path, so that it ranks after every feasible one."""
SLOPE_UNIT = 0.1
"""Slopes beyond their limits count in these; the limits themselves may be 0."""
SHORT_M = 1e-6
"""Stands for the length of a leg without any."""


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
        terrain = Terrain(base_m, wave, peaks)
        problem = PathProblem(origin_m, target_m, terrain, radars, obstacles, others, separations_m, bounds)
        corners = np.empty((interiors.shape[1] // 3 + 2, 3))
        corners[0] = problem.origin_m
        corners[-1] = problem.target_m
        for k in range(1, len(corners) - 1):
            corners[k] = interiors[i, 3 * k - 3 : 3 * k]
        costs[i] = _path_cost(corners, problem, graded, terms[i])


@jit
def _path_cost(corners: Any, problem: Any, graded: Any, terms: Any) -> float:
    """f of one path (3); fills in its five terms."""
    bounds = problem.bounds
    legs = len(corners) - 1
    arcs = np.empty(legs)
    violations, excess = _limits(corners, bounds, arcs)
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

        least, shortfall = leg_clearance_m(
            p, q, passed[k], passed[k + 1], problem.terrain, bounds.clearance_m, bounds.climb_out_m
        )
        least_sum += least
        if least < 0.0:
            underground += 1
            depth -= least
        if shortfall > 0.0:
            violations += 1
            excess += shortfall / 1000.0

        for i in range(len(problem.radars)):
            radar += radar_integral_m(p, q, problem.radars[i])

        for i in range(len(problem.obstacles)):
            missing = problem.obstacles[i, 4] - least_wall_distance_m(p, q, problem.obstacles[i])
            if missing > 0.0:
                violations += 1
                collision += 1.0 + (missing / 1000.0 if graded else 0.0)

        start, end = passed[k] / passed[legs], passed[k + 1] / passed[legs]
        for i in range(len(problem.others)):
            distance, other_legs[i] = least_separation_m(p, q, start, end, problem.others[i], other_legs[i])
            missing = problem.separations_m[i] - distance
            if missing > 0.0:
                violations += 1
                collision += 1.0 + (missing / 1000.0 if graded else 0.0)

    terms[0] = length / 1000.0
    if underground == 0:
        terms[1] = bounds.terrain_constant_km2 * legs / max(least_sum / 1000.0, 1e-9)
    else:
        terms[1] = bounds.terrain_penalty_km * (1.0 + (depth / 1000.0 if graded else 0.0))
        violations += 1
    terms[2] = radar / 1000.0
    terms[3] = bounds.collision_penalty_km * collision
    terms[4] = _altitude_deviation_m(corners) / 1000.0
    f: float = terms[0] + terms[1] + terms[2] + terms[3] + terms[4]
    if violations == 0:
        return min(f, 0.5 * INFEASIBLE_KM)
    if graded:
        f += bounds.collision_penalty_km * (violations + excess)
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
def _limits(corners: Any, bounds: Any, arcs: Any) -> tuple[int, float]:
    """Violations of the box (1) and the constraints (12), and by how much in all, relative to each limit.

    Fills in `arcs`: horizontal length of each leg between the middles of the fillets at its ends. Slopes are along
    those, as the aircraft flies them.
    """
    legs = len(corners) - 1
    violations = 0
    excess = 0.0
    for k in range(1, legs):
        x, y, z = corners[k, 0], corners[k, 1], corners[k, 2]
        outside = max(0.0, bounds.x_min_m - x, x - bounds.x_max_m) + max(0.0, bounds.y_min_m - y, y - bounds.y_max_m)
        outside += max(0.0, bounds.z_min_m - z, z - bounds.z_max_m)
        if outside > 0.0:
            violations += 1
            excess += outside / 1000.0

    dx, dy = corners[1, 0] - corners[0, 0], corners[1, 1] - corners[0, 1]
    across = max(math.sqrt(dx * dx + dy * dy), SHORT_M)
    trim_before = 0.0
    for k in range(legs):
        room = across if k == 0 else across / 2.0
        turn = trim = tangent = 0.0
        across_next = across
        if k + 1 < legs:
            dx_next, dy_next = corners[k + 2, 0] - corners[k + 1, 0], corners[k + 2, 1] - corners[k + 1, 1]
            across_next = max(math.sqrt(dx_next * dx_next + dy_next * dy_next), SHORT_M)
            room = min(room, across_next if k + 2 == legs else across_next / 2.0)
            turn = abs(math.atan2(dx * dy_next - dy * dx_next, dx * dx_next + dy * dy_next))
            half_tangent = math.tan(turn / 2.0)
            tangent = bounds.fillet_radius_m * half_tangent
            trim = min(tangent, room) * (1.0 - turn / (2.0 * half_tangent) if half_tangent > 1e-6 else 0.0)
            dx, dy = dx_next, dy_next
        dz = corners[k + 1, 2] - corners[k, 2]
        length = math.sqrt(across * across + dz * dz)
        arcs[k] = max(across - trim_before - trim, SHORT_M)
        slope = dz / arcs[k]
        for over in (
            1.0 - length / bounds.leg_min_m,
            length / bounds.leg_max_m - 1.0,
            turn / bounds.turn_max - 1.0,
            min(tangent / room - 1.0, 10.0),
            min((slope - bounds.slope_max) / SLOPE_UNIT, 10.0),
            min((bounds.slope_min - slope) / SLOPE_UNIT, 10.0),
        ):
            if over > 0.0:
                violations += 1
                excess += over
        across, trim_before = across_next, trim
    return violations, excess


def with_progress(corners_m: FloatArray, problem: PathProblem) -> FloatArray:
    """(m, 4) corners of a path and the part of the flight after which each is passed, for `PathProblem.others`."""
    arcs = np.empty(len(corners_m) - 1)
    _limits(corners_m, problem.bounds, arcs)
    passed = np.concatenate([[0.0], np.cumsum(arcs)])
    return np.column_stack([corners_m, passed / passed[-1]])
