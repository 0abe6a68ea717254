"""The route of a slot formation of which only the ends are given: a path for its middle that leaves room for all."""

import math
from collections.abc import Callable

import numpy as np
import numpy.typing as npt
from scipy.ndimage import maximum_filter

from missions.environment import Terrain
from missions.environment.obstacles import Obstacle, wall_distances_m
from missions.errors import InputError
from missions.scenario import Scenario, VehicleModel
from planner.cost.problem import PLANNING_MARGINS, PathProblem, path_problem
from planner.fit_slots import FittedSlots, fit_slots

FloatArray = npt.NDArray[np.float64]
FindPath = Callable[[PathProblem, int], FloatArray | None]
"""Finds a path, (m, 3) corners, with a number of interior waypoints; None when there is none."""

WIDTHS = (1.0, 0.75, 0.5, 0.25, 0.0)
"""Parts of the formation's half-width that are left free on both sides of a route, widest first."""
HASTY = 0.1
"""Part of the depth that legs are made long for where no route has legs for all of it: what does not fit then is found
when the slots are fitted."""
SPARE_SLOPE = 0.95
"""Part of the slope limits that a route may use: not all slots fly at its speed."""
LONG = 3.0
"""Legs are longer by this than what turns take from those of the slots on the inside, where the limits let them."""
FILLED = 0.7
"""Part of the straight line that the shortest legs may fill: the fewer waypoints, the longer the legs."""


def find_route(scenario: Scenario, find: FindPath) -> FittedSlots:
    """Search for a route that has room for the whole formation, or else for the widest part of it, and fit the slots.

    Raises:
        InputError: there is none; says what was wrong with the last one.
    """
    depth_m = max(vehicle.slot.behind_m for vehicle in scenario.vehicles if vehicle.slot)
    why = f"no path was found between its ends whose legs are long and flat enough for slots {depth_m:.0f} m deep"
    for share, depth_share in (*((width, 1.0) for width in WIDTHS), *((width, HASTY) for width in WIDTHS)):
        problem = route_problem(scenario, share, depth_share)
        line_m = math.dist(problem.origin_m, problem.target_m)
        waypoints = min(scenario.search.waypoints, max(1, int(FILLED * line_m / problem.bounds.leg_min_m) - 1))
        route_m = find(problem, waypoints)
        if route_m is None:
            continue
        try:
            return fit_slots(scenario, route_m)
        except InputError as error:
            why = str(error)
    raise InputError(f"{scenario.name}: route: {why}; move its ends, loosen limits, or make the formation smaller")


def route_problem(scenario: Scenario, share: float, depth_share: float = 1.0) -> PathProblem:
    """The problem of a path in the middle of a formation, with a part of its half-width free on both sides and its legs
    long enough for a part of its depth.

    Obstacles keep that much more distance, except where an end of the route is nearer; the area is that much
    narrower; the ground is as high as it is anywhere that near. Two turns, and at the end the place of the last slot,
    take something from legs on the inside and give it to those on the outside: the route's legs are so much longer
    than the shortest and shorter than the longest, and as much less steep. Climbs are those that power allows against
    the forecast wind.
    """
    assert scenario.route is not None
    route = scenario.route
    slots = [vehicle.slot for vehicle in scenario.vehicles if vehicle.slot]
    half_width, depth = max(abs(slot.left_m) for slot in slots), max(slot.behind_m for slot in slots)
    aside = share * half_width
    middle = VehicleModel(name="route", sysid=1, origin=route.points[0], target=route.points[-1])
    against_wind = route.ground_speed_m_s + math.hypot(*scenario.wind.forecast_m_s)
    problem = path_problem(scenario, middle, np.empty((0, 2, 4)), against_wind, PLANNING_MARGINS)
    ends = np.array([problem.origin_m, problem.target_m])
    obstacles = problem.obstacles.copy()
    for row in obstacles:
        at_ends = float(wall_distances_m(ends, Obstacle(*row[:4].tolist())).min()) - 1e-3
        row[4] = max(row[4], min(row[4] + aside, at_ends))
    bounds = problem.bounds
    two_turns = 2.0 * math.tan(bounds.turn_max / 2)
    cut = aside * two_turns + depth_share * depth
    longest = bounds.leg_max_m - half_width * two_turns - depth
    shortest = max(bounds.leg_min_m + cut, min(LONG * cut, longest / 2))
    steeper = shortest / (shortest - cut)
    return problem._replace(
        terrain=widened(problem.terrain, aside),
        obstacles=obstacles,
        bounds=bounds._replace(
            x_min_m=bounds.x_min_m + aside,
            x_max_m=bounds.x_max_m - aside,
            y_min_m=bounds.y_min_m + aside,
            y_max_m=bounds.y_max_m - aside,
            leg_min_m=shortest,
            leg_max_m=max(longest, shortest),
            slope_min=SPARE_SLOPE * bounds.slope_min / steeper,
            slope_max=SPARE_SLOPE * bounds.slope_max / steeper,
        ),
    )


def widened(terrain: Terrain, aside_m: float) -> Terrain:
    """Ground about as high everywhere as the given one is anywhere within a distance; a peak keeps its form."""
    if aside_m == 0.0:
        return terrain
    peaks = np.array(terrain.peaks, dtype=np.float64).reshape(-1, 5)
    peaks[peaks[:, 0] > 0.0, 3:] += aside_m
    posts = terrain.posts
    if len(posts):
        across, up = _steps(aside_m, terrain.spacing_x_m), _steps(aside_m, terrain.spacing_y_m)
        near = np.hypot(across[None, :], up[:, None]) <= aside_m
        posts = np.asarray(maximum_filter(posts, footprint=near, mode="nearest"), dtype=np.float64)
    return terrain._replace(peaks=peaks, posts=posts).as_array()


def _steps(reach_m: float, spacing_m: float) -> FloatArray:
    """Offsets of a raster's posts within a distance."""
    count = int(reach_m / spacing_m)
    return np.linspace(-count * spacing_m, count * spacing_m, 2 * count + 1)
