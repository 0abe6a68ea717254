"""What the descent minimises: the objective (3) with the limits as an augmented Lagrangian, and its exact gradient.

The objective alone stalls a gradient method: f_R jumps at a radar's edge and a limit is a cliff. Here a limit is a
signed distance c <= 0 (to walls, spheres, ground, other UAVs, and each constraint of (12)), which enters as
((max(0, mu + rho c))^2 - mu^2) / (2 rho) with a multiplier mu of its own (Powell, Hestenes, Rockafellar). A radar is
either kept out of, as a limit, or crossed, at the price of (7)-(8). All in kilometres; angles count a kilometre a
radian.
"""

import math
from typing import Any

import numpy as np

from missions.environment.terrain import ground_height_and_slope
from planner.compiled import compile_shared, jit
from planner.cost.radar import radar_integral_m
from planner.cost.separation import least_separation_m
from planner.cost.terrain import leg_clearance_m
from planner.skein.distances import sphere_distance, wall_distance
from planner.skein.radar_slope import add_radar_slope

_ground = compile_shared(ground_height_and_slope)

KM = 1e-3
LEG_LIMITS = 9
"""Limits of each leg beside those of obstacles, radars and other UAVs."""
WAYPOINT_LIMITS = 6
SLOPE_WEIGHT = 3.0
"""Slopes are stiff: a metre of height is worth more than a metre of way."""
LEAST_CLEARANCE_KM = 0.02
"""A mean clearance below this has no slope in f_T: the limit of clearance drives a path out of the ground."""
TURN_MOST = 3.0
"""The half tangent of sharper turns is taken at this angle, radians."""


@jit
def limits_count(legs: int, problem: Any) -> int:
    """How many limits a path of so many legs has."""
    things = len(problem.obstacles) + len(problem.radars) + len(problem.others)
    return legs * (LEG_LIMITS + WAYPOINT_LIMITS + things) + 1


@jit
def merit(
    corners: Any, problem: Any, crossed: Any, multipliers: Any, rho: float, soft_m: float, limits: Any, gradient: Any
) -> float:
    """The augmented Lagrangian of one path, kilometres.

    Args:
        corners: (n + 1, 3) path, metres.
        crossed: (radars,) whether each may be flown through.
        multipliers: (limits_count,), at least 0.
        rho: weight of the squares, 1 / km.
        soft_m: softness of the minimum over a leg in (6), metres.
        limits: (limits_count,), set to c of each limit, km: kept where not above 0.
        gradient: (n + 1, 3), set to the slopes, km / km.
    """
    bounds = problem.bounds
    legs = len(corners) - 1
    gradient[:] = 0.0
    limits[:] = -1e3
    across = np.empty(legs)
    arcs = np.empty(legs)
    turns = np.zeros(legs + 1)
    for k in range(legs):
        dx, dy = corners[k + 1, 0] - corners[k, 0], corners[k + 1, 1] - corners[k, 1]
        across[k] = max(math.sqrt(dx * dx + dy * dy), 1e-3)
        arcs[k] = across[k]
    for k in range(1, legs):
        ax, ay = corners[k, 0] - corners[k - 1, 0], corners[k, 1] - corners[k - 1, 1]
        bx, by = corners[k + 1, 0] - corners[k, 0], corners[k + 1, 1] - corners[k, 1]
        turns[k] = math.atan2(ax * by - ay * bx, ax * bx + ay * by)
        half = min(abs(turns[k]), TURN_MOST) / 2.0
        trim = bounds.fillet_radius_m * (math.tan(half) - half)
        arcs[k - 1] -= min(trim, 0.3 * across[k - 1])
        arcs[k] -= min(trim, 0.3 * across[k])
    passed = np.zeros(legs + 1)
    for k in range(legs):
        passed[k + 1] = passed[k] + arcs[k]
    total = passed[legs]

    turn_slope = np.zeros(legs + 1)  # of the merit in |turn|, arc, and length passed before a corner
    arc_slope = np.zeros(legs)
    passed_slope = np.zeros(legs + 1)
    other_legs = np.zeros(len(problem.others), np.int64)
    value: float = 0.0
    clearance_sum = 0.0
    clearance_weight = np.empty((legs, 3))
    clearance_place = np.empty(legs)
    heights = np.empty((legs + 1, 3))
    for k in range(legs + 1):
        heights[k] = _ground(corners[k, 0], corners[k, 1], problem.terrain)

    per_leg = LEG_LIMITS + WAYPOINT_LIMITS + len(problem.obstacles) + len(problem.radars) + len(problem.others)
    for k in range(legs):
        p, q = corners[k], corners[k + 1]
        dx, dy, dz = q[0] - p[0], q[1] - p[1], q[2] - p[2]
        length = max(math.sqrt(dx * dx + dy * dy + dz * dz), 1e-3)
        i = k * per_leg

        # f_L, and the least and largest leg
        pull = 1.0
        push, added = _limit(i, (bounds.leg_min_m - length) * KM, multipliers, rho, limits)
        value += added
        pull -= push
        push, added = _limit(i + 1, (length - bounds.leg_max_m) * KM, multipliers, rho, limits)
        value += length * KM + added
        pull += push
        _pull(gradient, k, pull * dx / length, pull * dy / length, pull * dz / length)

        # slopes, along the arcs
        push, added = _limit(i + 2, (dz - bounds.slope_max * arcs[k]) * KM * SLOPE_WEIGHT, multipliers, rho, limits)
        value += added
        gradient[k, 2] -= SLOPE_WEIGHT * push
        gradient[k + 1, 2] += SLOPE_WEIGHT * push
        arc_slope[k] -= SLOPE_WEIGHT * push * bounds.slope_max
        push, added = _limit(i + 3, (bounds.slope_min * arcs[k] - dz) * KM * SLOPE_WEIGHT, multipliers, rho, limits)
        value += added
        gradient[k, 2] += SLOPE_WEIGHT * push
        gradient[k + 1, 2] -= SLOPE_WEIGHT * push
        arc_slope[k] += SLOPE_WEIGHT * push * bounds.slope_min

        # the turn at the leg's end, and room for its fillet
        if k + 1 < legs:
            turn = abs(turns[k + 1])
            push, added = _limit(i + 4, turn - bounds.turn_max, multipliers, rho, limits)
            value += added
            turn_slope[k + 1] += push
            half = min(turn, TURN_MOST) / 2.0
            tangent = bounds.fillet_radius_m * math.tan(half)
            tangent_slope = 0.5 * bounds.fillet_radius_m / (math.cos(half) * math.cos(half)) * KM
            share = 1.0 if k == 0 else 0.5
            push, added = _limit(i + 5, min(tangent - share * across[k], 2e3) * KM, multipliers, rho, limits)
            value += added
            turn_slope[k + 1] += push * tangent_slope
            _pull(gradient, k, -push * share * dx / across[k], -push * share * dy / across[k], 0.0)
            share = 1.0 if k + 2 == legs else 0.5
            push, added = _limit(i + 6, min(tangent - share * across[k + 1], 2e3) * KM, multipliers, rho, limits)
            value += added
            turn_slope[k + 1] += push * tangent_slope
            ex, ey = corners[k + 2, 0] - q[0], corners[k + 2, 1] - q[1]
            _pull(gradient, k + 1, -push * share * ex / across[k + 1], -push * share * ey / across[k + 1], 0.0)

        # clearance
        least, lowest, shortfall, shortest = leg_clearance_m(
            p, q, passed[k], passed[k + 1], problem.terrain, bounds.clearance_m, bounds.climb_out_m
        )
        clearance_place[k] = lowest
        clearance_sum += _soft_least(p[2] - heights[k, 0], q[2] - heights[k + 1, 0], least, soft_m, clearance_weight[k])
        push, added = _limit(i + 7, shortfall * KM, multipliers, rho, limits)
        if added != 0.0:
            value += added
            _raise(gradient, k, p, q, shortest, -push, problem.terrain)
            if passed[k] + shortest * arcs[k] < bounds.climb_out_m:
                ramp = push * bounds.clearance_m / bounds.climb_out_m
                passed_slope[k] += ramp * (1.0 - shortest)
                passed_slope[k + 1] += ramp * shortest
        push, added = _limit(i + 8, -least * KM, multipliers, rho, limits)
        if added != 0.0:
            value += added
            _raise(gradient, k, p, q, lowest, -push, problem.terrain)
        i += LEG_LIMITS

        # the box (1) at the leg's end
        if k + 1 < legs:
            for axis in range(3):
                low = bounds[2 * axis]
                high = bounds[2 * axis + 1]
                push, added = _limit(i + 2 * axis, (low - q[axis]) * KM, multipliers, rho, limits)
                value += added
                gradient[k + 1, axis] -= push
                push, added = _limit(i + 2 * axis + 1, (q[axis] - high) * KM, multipliers, rho, limits)
                value += added
                gradient[k + 1, axis] += push
        i += WAYPOINT_LIMITS

        for j in range(len(problem.obstacles)):
            distance, t, nx, ny, nz = wall_distance(p, q, problem.obstacles[j])
            if distance < math.inf:
                push, added = _limit(i + j, (problem.obstacles[j, 4] - distance) * KM, multipliers, rho, limits)
                value += added
                _push(gradient, k, t, -push * nx, -push * ny, -push * nz)
        i += len(problem.obstacles)

        for j in range(len(problem.radars)):
            radar = problem.radars[j]
            if crossed[j]:
                integral = radar_integral_m(p, q, radar)
                if integral > 0.0:
                    value += integral * KM
                    add_radar_slope(p, q, radar, gradient[k], gradient[k + 1])
            else:
                distance, t, nx, ny, nz = sphere_distance(p, q, radar[0], radar[1], radar[2])
                push, added = _limit(i + j, (radar[3] - distance) * KM, multipliers, rho, limits)
                if added != 0.0:
                    value += added
                    _push(gradient, k, t, -push * nx, -push * ny, -push * nz)
        i += len(problem.radars)

        start, end = passed[k] / total, passed[k + 1] / total
        for j in range(len(problem.others)):
            other = problem.others[j]
            distance, at, other_legs[j] = least_separation_m(p, q, start, end, other, other_legs[j])
            push, added = _limit(i + j, (problem.separations_m[j] - distance) * KM, multipliers, rho, limits)
            if added != 0.0:
                value += added
                span = max(end - start, 1e-9)
                t = min(1.0, max(0.0, (at - start) / span))
                x, y, z, ux, uy, uz = _at(other, at)
                nx, ny, nz = p[0] + t * dx - x, p[1] + t * dy - y, p[2] + t * dz - z
                norm = max(math.sqrt(nx * nx + ny * ny + nz * nz), 1e-3)
                nx, ny, nz = nx / norm, ny / norm, nz / norm
                _push(gradient, k, t, -push * nx, -push * ny, -push * nz)
                later = push * (nx * dx + ny * dy + nz * dz) / (span * total)
                if t < 1e-9 or t > 1.0 - 1e-9:  # nearest at an own corner, whose time moves, and not at a fixed time
                    later = push * (nx * ux + ny * uy + nz * uz) / total
                passed_slope[k] += later * (1.0 - t)
                passed_slope[k + 1] += later * t
                passed_slope[legs] -= later * at

    # the least length flown
    push, added = _limit(len(limits) - 1, (bounds.length_min_m - total) * KM, multipliers, rho, limits)
    value += added
    passed_slope[legs] -= push

    # f_T (5)-(6)
    least_sum = LEAST_CLEARANCE_KM * legs
    mean_slope = 0.0
    if clearance_sum * KM > least_sum:
        least_sum = clearance_sum * KM
        mean_slope = -bounds.terrain_constant_km2 * legs / (least_sum * least_sum)
    value += bounds.terrain_constant_km2 * legs / least_sum
    if mean_slope != 0.0:
        for k in range(legs):
            for end in range(2):
                weight = mean_slope * clearance_weight[k, end]
                gradient[k + end, 2] += weight
                gradient[k + end, 0] -= weight * heights[k + end, 1]
                gradient[k + end, 1] -= weight * heights[k + end, 2]
            if clearance_weight[k, 2] > 0.0:
                weight = mean_slope * clearance_weight[k, 2]
                _raise(gradient, k, corners[k], corners[k + 1], clearance_place[k], weight, problem.terrain)

    # f_H (11)
    mean = 0.0
    for k in range(legs + 1):
        mean += corners[k, 2] / (legs + 1)
    squares = 0.0
    for k in range(legs + 1):
        squares += (corners[k, 2] - mean) * (corners[k, 2] - mean)
    deviation = max(math.sqrt(squares / legs), 1.0)
    value += math.sqrt(squares / legs) * KM
    for k in range(legs + 1):
        gradient[k, 2] += (corners[k, 2] - mean) / (legs * deviation)

    # arcs depend on the corners through lengths and turns
    later = 0.0
    for k in range(legs, 0, -1):
        later += passed_slope[k]
        arc_slope[k - 1] += later
    for k in range(legs):
        dx, dy = corners[k + 1, 0] - corners[k, 0], corners[k + 1, 1] - corners[k, 1]
        slope = arc_slope[k]
        _pull(gradient, k, slope * dx / across[k], slope * dy / across[k], 0.0)
    for k in range(1, legs):
        half_tangent = math.tan(min(abs(turns[k]), TURN_MOST) / 2.0)
        trim_slope = 0.5 * bounds.fillet_radius_m * half_tangent * half_tangent * KM
        slope = turn_slope[k] - (arc_slope[k - 1] + arc_slope[k]) * trim_slope
        if slope != 0.0:
            _turn(gradient, k, corners, math.copysign(slope, turns[k]), across[k - 1], across[k])
    return value


@jit
def _limit(i: int, c: float, multipliers: Any, rho: float, limits: Any) -> tuple[float, float]:
    """Note limit i; the slope of its term in c, and the term."""
    limits[i] = c
    push = multipliers[i] + rho * c
    if push <= 0.0:
        return 0.0, -0.5 * multipliers[i] * multipliers[i] / rho
    return push, 0.5 * (push * push - multipliers[i] * multipliers[i]) / rho


@jit
def _pull(gradient: Any, k: int, x: float, y: float, z: float) -> None:
    """A slope in the vector from corner k to the next."""
    gradient[k, 0] -= x
    gradient[k, 1] -= y
    gradient[k, 2] -= z
    gradient[k + 1, 0] += x
    gradient[k + 1, 1] += y
    gradient[k + 1, 2] += z


@jit
def _push(gradient: Any, k: int, t: float, x: float, y: float, z: float) -> None:
    """A slope in the point at the part t of leg k."""
    gradient[k, 0] += (1.0 - t) * x
    gradient[k, 1] += (1.0 - t) * y
    gradient[k, 2] += (1.0 - t) * z
    gradient[k + 1, 0] += t * x
    gradient[k + 1, 1] += t * y
    gradient[k + 1, 2] += t * z


@jit
def _raise(gradient: Any, k: int, p: Any, q: Any, t: float, weight: float, terrain: Any) -> None:
    """A slope in the height above ground at the part t of leg k."""
    _, ground_x, ground_y = _ground(p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1]), terrain)
    _push(gradient, k, t, -weight * ground_x, -weight * ground_y, weight)


@jit
def _turn(gradient: Any, k: int, corners: Any, slope: float, before: float, after: float) -> None:
    """A slope in the signed turn at corner k, radians; kilometres a radian, so metres count by `KM`."""
    ax, ay = corners[k, 0] - corners[k - 1, 0], corners[k, 1] - corners[k - 1, 1]
    bx, by = corners[k + 1, 0] - corners[k, 0], corners[k + 1, 1] - corners[k, 1]
    scale_a, scale_b = slope / (KM * before * before), slope / (KM * after * after)
    _pull(gradient, k - 1, ay * scale_a, -ax * scale_a, 0.0)
    _pull(gradient, k, -by * scale_b, bx * scale_b, 0.0)


@jit
def _soft_least(start: float, end: float, between: float, soft_m: float, weights: Any) -> float:
    """A smooth least of the clearances at a leg's ends and of the least between them; fills in its slopes."""
    least = min(start, end, between)
    weights[0] = math.exp((least - start) / soft_m)
    weights[1] = math.exp((least - end) / soft_m)
    weights[2] = math.exp((least - between) / soft_m) if between < min(start, end) - 1e-6 else 0.0
    total = weights[0] + weights[1] + weights[2]
    for i in range(3):
        weights[i] /= total
    soft: float = least - soft_m * math.log(total)
    return soft


@jit
def _at(other: Any, at: float) -> tuple[float, float, float, float, float, float]:
    """Where another UAV is after the part `at` of the flight, and how fast it goes, metres a flight."""
    leg = 0
    while leg + 2 < len(other) and other[leg + 1, 3] < at:
        leg += 1
    span = max(other[leg + 1, 3] - other[leg, 3], 1e-12)
    b = (at - other[leg, 3]) / span
    x, y, z = other[leg + 1, 0] - other[leg, 0], other[leg + 1, 1] - other[leg, 1], other[leg + 1, 2] - other[leg, 2]
    return other[leg, 0] + b * x, other[leg, 1] + b * y, other[leg, 2] + b * z, x / span, y / span, z / span
