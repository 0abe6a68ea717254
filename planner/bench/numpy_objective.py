"""The objective in plain numpy: what the compiled kernel is measured against, and its independent twin in tests.

Whole arrays over paths and legs, nothing compiled. One UAV alone; the ground is peaks or a raster, without a wave.
"""

from typing import Any

import numpy as np
import numpy.typing as npt

from missions.environment.radars import CORE
from planner.bench.numpy_ground import clearances_m
from planner.cost.constraints import SHORT_M, SLOPE_UNIT
from planner.cost.kernel import INFEASIBLE_KM, TOUCH_M
from planner.cost.obstacles import GOLDEN, STEPS
from planner.cost.problem import Bounds, PathProblem
from planner.cost.radar import LEAST_PASS

FloatArray = npt.NDArray[np.float64]


def evaluate_in_numpy(interiors: FloatArray, problem: PathProblem) -> tuple[FloatArray, FloatArray]:
    """Costs (n,) and terms (n, 5) of paths (n, 3 m), graded, as `planner.cost.kernel.evaluate` gives them.

    Raises:
        ValueError: the problem has other UAVs or a datum wave.
    """
    if len(problem.others) or problem.terrain.wave[0] != 0.0:
        raise ValueError("the numpy form knows neither other UAVs nor a datum wave")
    bounds, n = problem.bounds, len(interiors)
    ends = (np.broadcast_to(end, (n, 1, 3)) for end in (problem.origin_m, problem.target_m))
    origin, target = ends
    corners = np.concatenate([origin, interiors.reshape(n, -1, 3), target], axis=1)
    legs = np.diff(corners, axis=1)
    broken, excess, arcs = _broken_limits(corners, legs, bounds)
    passed = np.concatenate([np.zeros((n, 1)), np.cumsum(arcs, axis=1)], axis=1)

    least, shortfall = clearances_m(corners, passed, problem.terrain, bounds)
    underground = least < -TOUCH_M
    short = shortfall > TOUCH_M
    broken = broken + short.sum(axis=1)
    excess = excess + np.where(short, shortfall, 0.0).sum(axis=1) / 1000.0
    collision = _collisions(corners, legs, problem.obstacles)

    terms = np.empty((n, 5))
    terms[:, 0] = np.linalg.norm(legs, axis=2).sum(axis=1) / 1000.0
    above = bounds.terrain_constant_km2 * legs.shape[1] / np.maximum(least.sum(axis=1) / 1000.0, 1e-9)
    depth = np.where(underground, -least, 0.0).sum(axis=1)
    through = bounds.terrain_penalty_km * (1.0 + depth / 1000.0)
    terms[:, 1] = np.where(underground.any(axis=1), through, above)
    terms[:, 2] = sum(_radar_m(corners, legs, radar) for radar in problem.radars) / 1000.0
    terms[:, 3] = bounds.collision_penalty_km * collision
    terms[:, 4] = np.std(corners[:, :, 2], axis=1, ddof=1) / 1000.0
    f = terms.sum(axis=1)
    feasible = (broken == 0) & ~underground.any(axis=1) & (collision == 0.0)
    penalised = INFEASIBLE_KM + f + bounds.collision_penalty_km * (broken + excess)
    return np.where(feasible, np.minimum(f, 0.5 * INFEASIBLE_KM), penalised), terms


def _broken_limits(corners: FloatArray, legs: FloatArray, bounds: Bounds) -> tuple[Any, Any, FloatArray]:
    """Violations and excess (n,) of the box (1) and the constraints (12), and the arcs (n, legs)."""
    low = np.array([bounds.x_min_m, bounds.y_min_m, bounds.z_min_m])
    high = np.array([bounds.x_max_m, bounds.y_max_m, bounds.z_max_m])
    inner = corners[:, 1:-1]
    outside = np.maximum(0.0, np.maximum(low - inner, inner - high)).sum(axis=2)
    violations, excess = (outside > 0.0).sum(axis=1), outside.sum(axis=1) / 1000.0

    across = np.maximum(np.hypot(legs[:, :, 0], legs[:, :, 1]), SHORT_M)
    before, after = legs[:, :-1], legs[:, 1:]
    cross = before[:, :, 0] * after[:, :, 1] - before[:, :, 1] * after[:, :, 0]
    turn = np.abs(np.arctan2(cross, before[:, :, 0] * after[:, :, 0] + before[:, :, 1] * after[:, :, 1]))
    half = across / 2.0
    half[:, 0], half[:, -1] = across[:, 0], across[:, -1]
    room = np.minimum(half[:, :-1], half[:, 1:])
    half_tangent = np.tan(turn / 2.0)
    tangent = bounds.fillet_radius_m * half_tangent
    straight = half_tangent <= 1e-6
    cut = 1.0 - turn / (2.0 * np.where(straight, 1.0, half_tangent))
    trim = np.minimum(tangent, room) * np.where(straight, 0.0, cut)
    nothing = np.zeros((len(corners), 1))
    arcs = np.maximum(across - np.hstack([nothing, trim]) - np.hstack([trim, nothing]), SHORT_M)
    slope = legs[:, :, 2] / arcs
    length = np.hypot(across, legs[:, :, 2])
    short = np.maximum(0.0, 1.0 - arcs.sum(axis=1, keepdims=True) / max(bounds.length_min_m, SHORT_M))
    for over in (
        1.0 - length / bounds.leg_min_m,
        length / bounds.leg_max_m - 1.0,
        turn / bounds.turn_max - 1.0,
        np.minimum(tangent / room - 1.0, 10.0),
        np.minimum((slope - bounds.slope_max) / SLOPE_UNIT, 10.0),
        np.minimum((bounds.slope_min - slope) / SLOPE_UNIT, 10.0),
        short,
    ):
        violations = violations + (over > 0.0).sum(axis=1)
        excess = excess + np.maximum(over, 0.0).sum(axis=1)
    return violations, excess, arcs


def _radar_m(corners: FloatArray, legs: FloatArray, radar: FloatArray) -> FloatArray:
    """(n,) integral of (delta / D)^4 along paths (7)-(8), metres, in closed form."""
    radius, core = radar[3], CORE * radar[3]
    to_centre = radar[:3] - corners[:, :-1]
    length = np.maximum(np.linalg.norm(legs, axis=2), 1e-300)
    along = np.sum(to_centre * legs, axis=2) / length
    rho2 = np.maximum(0.0, np.sum(to_centre**2, axis=2) - along**2)
    reach = np.sqrt(np.maximum(0.0, radius**2 - rho2))
    start, end = np.maximum(-along, -reach), np.minimum(length - along, reach)
    half_core = np.sqrt(np.maximum(0.0, core**2 - rho2))
    rho = np.maximum(np.sqrt(rho2), LEAST_PASS * radius)

    def outside_core(s0: FloatArray, s1: FloatArray) -> FloatArray:
        rational = s1 / (rho**2 + s1**2) - s0 / (rho**2 + s0**2)
        value = (rational + (np.arctan(s1 / rho) - np.arctan(s0 / rho)) / rho) / (2.0 * rho**2)
        return np.where(s0 < s1, value, 0.0)

    total = np.maximum(0.0, np.minimum(end, half_core) - np.maximum(start, -half_core)) / core**4
    total = total + outside_core(np.maximum(start, half_core), end)
    total = total + outside_core(np.maximum(-end, half_core), -start)
    integral: FloatArray = radar[4] ** 4 * np.where((rho2 < radius**2) & (start < end), total, 0.0).sum(axis=1)
    return integral


def _collisions(corners: FloatArray, legs: FloatArray, obstacles: FloatArray) -> FloatArray:
    """(n,) legs too near to an obstacle, each with its missing kilometres (9)-(10)."""
    collision = np.zeros(len(corners))
    for x, y, radius, top, keep in obstacles:
        start = corners[:, :-1] - [x, y, 0.0]

        def distance(t: Any, start: FloatArray = start, radius: float = radius, top: float = top) -> FloatArray:
            point = start + t[..., None] * legs
            beside, above = np.hypot(point[..., 0], point[..., 1]) - radius, point[..., 2] - top
            corner = np.hypot(np.maximum(beside, 0.0), np.maximum(above, 0.0))
            signed: FloatArray = np.where((beside > 0.0) & (above > 0.0), corner, np.maximum(beside, above))
            return signed

        low, high = np.zeros(legs.shape[:2]), np.ones(legs.shape[:2])
        for _ in range(STEPS):
            t0, t1 = high - GOLDEN * (high - low), low + GOLDEN * (high - low)
            left = distance(t0) <= distance(t1)
            low, high = np.where(left, low, t0), np.where(left, t1, high)
        missing = keep - distance(0.5 * (low + high))
        collision += np.where(missing > 0.0, 1.0 + missing / 1000.0, 0.0).sum(axis=1)
    return collision
