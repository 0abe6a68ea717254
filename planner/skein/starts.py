"""What the search starts from: smooth bends at random, and routes through the plan view, with many spacings."""

import math

import numpy as np
import numpy.typing as npt

from missions.environment import ground_heights_m
from planner.cost.problem import PathProblem
from planner.skein.routes import RouteGrid, nominal_heights_m

FloatArray = npt.NDArray[np.float64]

WAVES = 3
"""Half waves of the shortest bend."""
SIDEWAYS = (0.03, 0.25)
"""Typical sideways bend of the mildest and of the wildest path, in lengths of the line."""
EVENNESS = (1.0, 30.0)
"""Of the spacing of waypoints: parameters of a Dirichlet distribution, from wild to even."""
LOW_M = 30.0
"""Starts stay so far above the least clearance where they can."""
POINTS = 200
"""Samples of a bend."""


def bent_paths(problem: PathProblem, waypoints: int, count: int, rng: np.random.Generator) -> FloatArray:
    """(count, n + 1, 3) corners of paths bent at random, the straight line first."""
    part = np.linspace(0.0, 1.0, POINTS)
    line = (problem.target_m - problem.origin_m)[:2]
    wave = np.arange(1, WAVES + 1)
    shapes = np.sin(np.pi * wave[:, None] * part)
    width = np.exp(rng.uniform(math.log(SIDEWAYS[0]), math.log(SIDEWAYS[1]), count))
    bends = (rng.normal(size=(count, WAVES)) * width[:, None] / wave) @ shapes
    bends[0] = 0.0
    straight = problem.origin_m[:2] + part[:, None] * line
    left = np.array([-line[1], line[0]])
    paths = [
        path_along(straight + bend[:, None] * left, problem, waypoints, None if i == 0 else rng)
        for i, bend in enumerate(bends)
    ]
    return np.array(paths)


def routed_paths(
    grid: RouteGrid, problem: PathProblem, waypoints: int, count: int, spacings: int, rng: np.random.Generator
) -> FloatArray:
    """(count x spacings, n + 1, 3) corners of paths along routes, the cheapest first; some evenly spaced, some not."""
    routes = [grid.route(rng=None if i == 0 else rng) for i in range(count)]
    return np.array(
        [path_along(route, problem, waypoints, None if i == 0 else rng) for i in range(spacings) for route in routes]
    )


def path_along(points: FloatArray, problem: PathProblem, waypoints: int, rng: np.random.Generator | None) -> FloatArray:
    """(waypoints + 2, 3) corners along a route (n, 2): evenly spaced, or with chance unevenly; climbing evenly, and
    above the ground where that can be reached."""
    passed = np.append(0.0, np.cumsum(np.hypot(*np.diff(points, axis=0).T)))
    if rng is None:
        part = np.linspace(0.0, 1.0, waypoints + 2)
    else:
        shares = rng.dirichlet(
            np.full(waypoints + 1, math.exp(rng.uniform(math.log(EVENNESS[0]), math.log(EVENNESS[1]))))
        )
        part = np.append(0.0, np.cumsum(shares))
    x, y = (np.interp(part * passed[-1], passed, points[:, axis]) for axis in range(2))
    b = problem.bounds
    low = ground_heights_m(x, y, problem.terrain) + b.clearance_m + LOW_M
    _, highest = nominal_heights_m(x, y, problem)
    even = problem.origin_m[2] + part * (problem.target_m[2] - problem.origin_m[2])
    corners = np.column_stack([x, y, np.minimum(np.maximum(even, low), highest)])
    corners[:, 0] = np.clip(corners[:, 0], b.x_min_m, b.x_max_m)
    corners[:, 1] = np.clip(corners[:, 1], b.y_min_m, b.y_max_m)
    corners[0], corners[-1] = problem.origin_m, problem.target_m
    return corners
