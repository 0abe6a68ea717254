"""Why a UAV has no path: at once where arithmetic shows it, else by what the best path that was found still breaks."""

import math
from collections.abc import Sequence

import numpy as np

from missions.errors import InputError
from planner.cost.kernel import INFEASIBLE_KM
from planner.cost.problem import PathProblem
from planner.find_path import PathFound
from planner.skein.merit import LEG_LIMITS, SLOPE_WEIGHT, WAYPOINT_LIMITS, limits_count, merit

SIDES = ("west", "east", "south", "north", "low", "high")


def require_reachable(name: str, problem: PathProblem, waypoints: int) -> None:
    """Raise InputError when no path whatever can keep to the limits of legs and slopes."""
    bounds, line = problem.bounds, problem.target_m - problem.origin_m
    longest_m = (waypoints + 1) * bounds.leg_max_m
    distance_m = float(np.linalg.norm(line))
    if distance_m > longest_m:
        raise InputError(
            f"{name}: target is {distance_m / 1000:.1f} km away, {waypoints + 1} legs of limits.leg_max_m reach "
            f"{longest_m / 1000:.1f} km; raise that or search.waypoints"
        )
    if distance_m < bounds.leg_min_m:
        raise InputError(f"{name}: target is closer than limits.leg_min_m = {bounds.leg_min_m:g}")
    climb_m = float(line[2])
    steepest = bounds.slope_max if climb_m > 0.0 else bounds.slope_min
    if climb_m and abs(climb_m) > abs(steepest) * longest_m:
        raise InputError(
            f"{name}: no path of climb angle under {_deg(steepest):.1f} deg: {climb_m:.0f} m of height in at most "
            f"{longest_m / 1000:.1f} km of way; move its target, or raise limits.leg_max_m or search.waypoints"
        )


def require_feasible(name: str, path: PathFound, *, avoided: Sequence[str] = ()) -> None:
    """Raise InputError, with what stands in the way, when a search found no feasible path.

    Args:
        name: of the UAV.
        path: that was found.
        avoided: names of the UAVs that it had to avoid, in the order of its problem.
    """
    if path.cost_km < INFEASIBLE_KM:
        return
    beside = f" beside {', '.join(avoided)}, whichever goes first" if avoided else ""
    raise InputError(
        f"{name}: no path found{beside} in {path.evaluations} evaluations: the best {broken_limit(path, avoided)}; "
        "move its target, loosen that limit, or raise search.waypoints or search.iterations"
    )


def broken_limit(path: PathFound, avoided: Sequence[str] = ()) -> str:
    """What of the limits a path breaks most, and where."""
    problem, corners = path.problem, path.corners_m
    legs = len(corners) - 1
    limits = np.empty(limits_count(legs, problem))
    slopes = np.empty_like(corners)
    crossed = np.ones(len(problem.radars), dtype=np.bool_)
    merit(corners, problem, crossed, np.zeros(len(limits)), 1.0, 1.0, limits, slopes)
    if limits[-1] == limits.max():
        return f"is {1000 * limits[-1]:.0f} m shorter than it must be to arrive with the others"
    leg, kind = divmod(int(np.argmax(limits[:-1])), (len(limits) - 1) // legs)
    over_m = 1000.0 * float(limits[:-1].max())
    start, end = corners[leg], corners[leg + 1]
    where = f"on leg {leg + 1}, from {_place(start)} to {_place(end)}"
    bounds = problem.bounds
    if kind in (0, 1):
        return f"has a leg {_metres(over_m)} m too {'short' if kind == 0 else 'long'} {where}"
    if kind in (2, 3):
        steepest = bounds.slope_max if kind == 2 else bounds.slope_min
        slope = math.atan2(end[2] - start[2], math.hypot(*(end - start)[:2]))
        verb = "climbs" if kind == 2 else "descends"
        return (
            f"{verb} at {abs(math.degrees(slope)):.1f} deg {where}, {over_m / SLOPE_WEIGHT:.0f} m more than "
            f"{_deg(steepest):.1f} deg allow"
        )
    if kind == 4:
        return f"turns by {math.degrees(bounds.turn_max + over_m / 1000.0):.0f} deg at {_place(end)}"
    if kind in (5, 6):
        return f"has no room for a turn at {_place(end)}: {_metres(over_m)} m are missing"
    if kind in (7, 8):
        return f"comes {_metres(over_m)} m too close to the ground {where}"
    kind -= LEG_LIMITS
    if kind < WAYPOINT_LIMITS:
        return f"lies {_metres(over_m)} m outside the area ({SIDES[kind]}) at {_place(end)}"
    kind -= WAYPOINT_LIMITS
    if kind < len(problem.obstacles):
        return f"comes {_metres(over_m)} m too close to obstacles[{kind}] {where}"
    other = kind - len(problem.obstacles) - len(problem.radars)
    return f"comes {_metres(over_m)} m too close to {avoided[other] if avoided else 'another UAV'} {where}"


def _place(point_m: np.ndarray) -> str:
    return f"({point_m[0]:.0f}, {point_m[1]:.0f}, {point_m[2]:.0f})"


def _metres(over_m: float) -> str:
    """To a decimal where little is missing: never 0."""
    return f"{over_m:.0f}" if over_m >= 10.0 else f"{math.ceil(10.0 * over_m) / 10.0:.1f}"


def _deg(slope: float) -> float:
    return math.degrees(math.atan(abs(slope)))
