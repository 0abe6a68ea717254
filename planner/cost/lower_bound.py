"""What no path can cost less than: a bound that every figure must respect (MODEL, section 2)."""

import math

from missions.environment import Terrain, ground_height_m
from planner.cost.problem import PathProblem


def lower_bound_km(problem: PathProblem, waypoints: int) -> float:
    """Lower bound of f (3) over all paths with so many interior waypoints, kilometres.

    f_L is at least the straight line. In f_T (5)-(6) the first and the last leg have no more clearance than their
    ends on the origin and the target, every other no more than from the lowest ground to the highest altitude. f_H (11)
    is least when all interior waypoints lie half-way up: then it is the climb over sqrt(2 n) for n legs.
    """
    legs = waypoints + 1
    origin, target = problem.origin_m, problem.target_m
    line_m = math.dist(origin, target)
    room_m = problem.bounds.z_max_m - _lowest_m(problem.terrain)
    at_ends_m = [float(end[2]) - ground_height_m(end[0], end[1], problem.terrain) for end in (origin, target)]
    clearances_m = sum(min(room_m, end_m) for end_m in at_ends_m) + (legs - 2) * room_m
    terrain_km = problem.bounds.terrain_constant_km2 * legs / max(clearances_m / 1000.0, 1e-9)
    altitude_km = abs(float(target[2] - origin[2])) / 1000.0 / math.sqrt(2.0 * legs)
    return line_m / 1000.0 + terrain_km + altitude_km


def _lowest_m(terrain: Terrain) -> float:
    """No ground is lower than this."""
    if len(terrain.posts):
        return float(terrain.posts.min())
    return terrain.base_m + sum(min(0.0, float(peak[0])) for peak in terrain.peaks)
