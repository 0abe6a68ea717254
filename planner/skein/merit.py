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

from missions.compiled import jit
from planner.cost.leg_box import apart, leg_box
from planner.cost.radar import radar_integral_m
from planner.cost.separation import least_separation_m
from planner.cost.terrain import leg_clearance_m
from planner.skein.distances import sphere_distance, wall_distance
from planner.skein.flown import add_flown_slopes, fly, room_m
from planner.skein.heights import add_height_slope, ground, ramp_slope
from planner.skein.radar_slope import add_radar_slope

KM = 1e-3
LEG_LIMITS = 9
"""Limits of each leg beside those of obstacles, radars and other UAVs."""
WAYPOINT_LIMITS = 6
LEVEL_M = 1.0
"""An altitude deviation below this has less slope than it should: right at 0 it has none."""
SLOPE_WEIGHT = 3.0
"""Slopes are stiff: a metre of height is worth more than a metre of way."""
LEAST_CLEARANCE_KM = 0.02
"""A mean clearance below this has no slope in f_T: the limit of clearance drives a path out of the ground."""
TURN_MOST = 2.5
"""No sharper turn asks for more room than this, radians."""


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
    bounds, terrain, obstacles, radars = problem.bounds, problem.terrain, problem.obstacles, problem.radars
    legs = len(corners) - 1
    gradient[:] = 0.0
    limits[:] = -1e3
    across, arcs, turns = np.empty(legs), np.empty(legs), np.empty(legs + 1)
    fly(corners, bounds.fillet_radius_m, across, turns, arcs)
    passed = np.zeros(legs + 1)
    for k in range(legs):
        passed[k + 1] = passed[k] + arcs[k]
    total = passed[legs]

    # slopes of the merit in what depends on all corners before those in the corners are known
    across_slope, arc_slope = np.zeros(legs), np.zeros(legs)
    turn_slope, passed_slope = np.zeros(legs + 1), np.zeros(legs + 1)
    other_legs = np.zeros(len(problem.others), np.int64)
    value: float = 0.0
    least_heights, least_places = np.empty(legs), np.empty(legs)

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
            before, after = room_m(k + 1, across)
            push, added = _limit(i + 5, (tangent - before) * KM, multipliers, rho, limits)
            value += added
            across_slope[k] -= push * before / across[k]
            push_after, added = _limit(i + 6, (tangent - after) * KM, multipliers, rho, limits)
            value += added
            across_slope[k + 1] -= push_after * after / across[k + 1]
            if turn < TURN_MOST:
                turn_slope[k + 1] += (push + push_after) * tangent_slope

        # clearance
        least, lowest, shortfall, shortest = leg_clearance_m(
            p, q, passed[k], passed[k + 1], terrain, bounds.clearance_m, bounds.climb_out_m
        )
        least_heights[k], least_places[k] = least, lowest
        push, added = _limit(i + 7, shortfall * KM, multipliers, rho, limits)
        value += added
        if push > 0.0:
            left = bounds.climb_out_m - passed[k] - shortest * arcs[k]
            ramp = ramp_slope(p, q, shortest, left, arcs[k], bounds, terrain)
            add_height_slope(p, q, shortest, ramp * arcs[k], -push, terrain, gradient[k], gradient[k + 1])
            passed_slope[k] += push * ramp * (1.0 - shortest)
            passed_slope[k + 1] += push * ramp * shortest
        push, added = _limit(i + 8, -least * KM, multipliers, rho, limits)
        value += added
        if push > 0.0:
            add_height_slope(p, q, lowest, 0.0, -push, terrain, gradient[k], gradient[k + 1])
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

        # A thing counts as far as its multiplier reaches; beyond, its term is constant.
        box = leg_box(p, q)
        for j in range(len(obstacles)):
            reach = obstacles[j, 4] + multipliers[i + j] / (rho * KM)
            distance = math.inf
            if not apart(box, obstacles[j, 0], obstacles[j, 1], obstacles[j, 2] + reach):
                distance, t, nx, ny, nz = wall_distance(p, q, obstacles[j], reach)
            if distance < math.inf:
                push, added = _limit(i + j, (obstacles[j, 4] - distance) * KM, multipliers, rho, limits)
                value += added
                if push > 0.0:
                    _push(gradient, k, t, -push * nx, -push * ny, -push * nz)
            else:
                value -= 0.5 * multipliers[i + j] * multipliers[i + j] / rho
        i += len(obstacles)

        for j in range(len(radars)):
            radar = radars[j]
            if crossed[j]:
                if not apart(box, radar[0], radar[1], radar[3]):
                    integral = radar_integral_m(p, q, radar)
                    if integral > 0.0:
                        value += integral * KM
                        add_radar_slope(p, q, radar, gradient[k], gradient[k + 1])
            elif apart(box, radar[0], radar[1], radar[3] + multipliers[i + j] / (rho * KM)):
                value -= 0.5 * multipliers[i + j] * multipliers[i + j] / rho
            else:
                distance, t, nx, ny, nz = sphere_distance(p, q, radar[0], radar[1], radar[2])
                push, added = _limit(i + j, (radar[3] - distance) * KM, multipliers, rho, limits)
                value += added
                if push > 0.0:
                    _push(gradient, k, t, -push * nx, -push * ny, -push * nz)
        i += len(radars)

        start, end = passed[k] / total, passed[k + 1] / total
        for j in range(len(problem.others)):
            other = problem.others[j]
            distance, at, other_legs[j] = least_separation_m(p, q, start, end, other, other_legs[j])
            push, added = _limit(i + j, (problem.separations_m[j] - distance) * KM, multipliers, rho, limits)
            value += added
            if push > 0.0:
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

    value += _terrain_cost(corners, terrain, bounds.terrain_constant_km2, soft_m, least_heights, least_places, gradient)
    value += _altitude_deviation(corners, gradient)
    later = 0.0
    for k in range(legs, 0, -1):
        later += passed_slope[k]
        arc_slope[k - 1] += later
    add_flown_slopes(corners, bounds.fillet_radius_m, across, turns, across_slope, turn_slope, arc_slope, gradient)
    return value


@jit
def _terrain_cost(
    corners: Any, terrain: Any, constant: float, soft_m: float, least_heights: Any, least_places: Any, gradient: Any
) -> float:
    """f_T (5)-(6), from the least height of each leg above ground and the part of it after which it is reached; a leg's
    ends count too, softly: which of them is least may change."""
    legs = len(corners) - 1
    heights, weights = np.empty((legs + 1, 3)), np.empty((legs, 3))
    for k in range(legs + 1):
        heights[k] = ground(corners[k, 0], corners[k, 1], terrain)
    clearance_sum = 0.0
    for k in range(legs):
        at_start, at_end = corners[k, 2] - heights[k, 0], corners[k + 1, 2] - heights[k + 1, 0]
        clearance_sum += _soft_least(at_start, at_end, least_heights[k], soft_m, weights[k])
    least_sum = LEAST_CLEARANCE_KM * legs
    if clearance_sum * KM <= least_sum:
        return constant * legs / least_sum
    least_sum = clearance_sum * KM
    slope = -constant * legs / (least_sum * least_sum)
    for k in range(legs):
        p, q, place = corners[k], corners[k + 1], least_places[k]
        if 0.0 < place < 1.0:
            between = slope * weights[k, 2]
            add_height_slope(p, q, place, 0.0, between, terrain, gradient[k], gradient[k + 1])
        else:
            weights[k, round(place)] += weights[k, 2]
        for end in range(2):
            weight = slope * weights[k, end]
            gradient[k + end, 0] -= weight * heights[k + end, 1]
            gradient[k + end, 1] -= weight * heights[k + end, 2]
            gradient[k + end, 2] += weight
    return constant * legs / least_sum


@jit
def _altitude_deviation(corners: Any, gradient: Any) -> float:
    """f_H (11)."""
    legs = len(corners) - 1
    mean = 0.0
    for k in range(legs + 1):
        mean += corners[k, 2] / (legs + 1)
    squares = 0.0
    for k in range(legs + 1):
        squares += (corners[k, 2] - mean) * (corners[k, 2] - mean)
    deviation = math.sqrt(squares / legs)
    for k in range(legs + 1):
        gradient[k, 2] += (corners[k, 2] - mean) / (legs * max(deviation, LEVEL_M))
    return deviation * KM


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
def _soft_least(start: float, end: float, between: float, soft_m: float, weights: Any) -> float:
    """A smooth least of the clearances at a leg's ends and of the least on it, be that at an end or between them; fills
    in its slopes."""
    least = min(start, end, between)
    weights[0] = math.exp((least - start) / soft_m)
    weights[1] = math.exp((least - end) / soft_m)
    weights[2] = math.exp((least - between) / soft_m)
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
