"""What the search starts from: smooth bends at random, and routes through the plan view, with many spacings."""

import math
from typing import Any

import numpy as np
import numpy.typing as npt

from missions.compiled import compile_shared, jit
from missions.environment import ground_height_m
from planner.cost.problem import PathProblem
from planner.skein.routes import RouteGrid

FloatArray = npt.NDArray[np.float64]
_ground_height_m = compile_shared(ground_height_m)

WAVES = 3
"""Half waves of the shortest bend."""
SIDEWAYS = (0.03, 0.25)
"""Typical sideways bend of the mildest and of the wildest path, in lengths of the line."""
EVENNESS = (1.0, 30.0)
"""Of the spacing of waypoints: parameters of a Dirichlet distribution, from wild to even."""
BEND = (0.08, 0.4)
"""Half width of the shortest and of the longest jump, in lengths of the path."""
JUMP = 0.04
"""Half of all jumps are smaller than this, in lengths of the line."""
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
    routes = straight + bends[:, :, None] * np.array([-line[1], line[0]])
    spacings = [spacing(waypoints, None if i == 0 else rng) for i in range(count)]
    return np.array([path_along(route, part, problem) for route, part in zip(routes, spacings, strict=True)])


def routed_paths(
    grid: RouteGrid,
    problem: PathProblem,
    waypoints: int,
    count: int,
    spacings: int,
    rng: np.random.Generator,
    *,
    chance: bool = False,
) -> FloatArray:
    """(count x spacings, n + 1, 3) corners of paths along routes: the cheapest first, evenly spaced first, unless all
    is left to chance."""
    routes = [grid.route(rng=rng if i or chance else None) for i in range(count)]
    return np.array(
        [
            path_along(route, spacing(waypoints, rng if i or chance else None), problem)
            for i in range(spacings)
            for route in routes
        ]
    )


def jumped_paths(corners_m: FloatArray, problem: PathProblem, count: int, rng: np.random.Generator) -> FloatArray:
    """(count, n + 1, 3) paths that leave a path of (n + 1, 3) corners by a bend of Cauchy-distributed size somewhere,
    with other spacings: most stay near, some go far, as the paper's mutants (43) do."""
    line = (problem.target_m - problem.origin_m)[:2]
    left = np.array([-line[1], line[0]])
    jumped = []
    for _ in range(count):
        part = np.linspace(0.0, 1.0, len(corners_m))
        middle, width = rng.uniform(0.0, 1.0), math.exp(rng.uniform(math.log(BEND[0]), math.log(BEND[1])))
        bump = np.cos(0.5 * np.pi * np.clip((part - middle) / width, -1.0, 1.0)) ** 2
        bump[[0, -1]] = 0.0
        size = float(np.clip(JUMP * math.tan(math.pi * (rng.random() - 0.5)), -0.5, 0.5))  # (43)
        route = corners_m[:, :2] + size * bump[:, None] * left
        jumped.append(path_along(route, spacing(len(corners_m) - 2, rng), problem))
    return np.array(jumped)


def spacing(waypoints: int, rng: np.random.Generator | None) -> FloatArray:
    """(waypoints + 2,) parts of a route at which its corners lie: even, or with chance uneven."""
    if rng is None:
        return np.linspace(0.0, 1.0, waypoints + 2)
    evenness = math.exp(rng.uniform(math.log(EVENNESS[0]), math.log(EVENNESS[1])))
    return np.append(0.0, np.minimum(np.cumsum(rng.dirichlet(np.full(waypoints + 1, evenness))), 1.0))


@jit
def path_along(points: Any, parts: Any, problem: Any) -> Any:
    """(m, 3) corners at parts (m,) of a route (n, 2): an even climb, but above the ground where that can be reached."""
    passed = np.zeros(len(points))
    for i in range(1, len(points)):
        passed[i] = passed[i - 1] + math.hypot(points[i, 0] - points[i - 1, 0], points[i, 1] - points[i - 1, 1])
    bounds, origin, target = problem.bounds, problem.origin_m, problem.target_m
    corners = np.empty((len(parts), 3))
    corners[0], corners[-1] = origin, target
    i = 0
    for k in range(1, len(parts) - 1):
        along = parts[k] * passed[-1]
        while i + 2 < len(points) and passed[i + 1] < along:
            i += 1
        share = (along - passed[i]) / max(passed[i + 1] - passed[i], 1e-9)
        x = points[i, 0] + share * (points[i + 1, 0] - points[i, 0])
        y = points[i, 1] + share * (points[i + 1, 1] - points[i, 1])
        low = _ground_height_m(x, y, problem.terrain) + bounds.clearance_m + LOW_M
        highest = min(
            bounds.z_max_m,
            origin[2] + bounds.slope_max * math.hypot(x - origin[0], y - origin[1]),
            target[2] - bounds.slope_min * math.hypot(x - target[0], y - target[1]),
        )
        even = origin[2] + parts[k] * (target[2] - origin[2])
        corners[k, 0] = min(max(x, bounds.x_min_m), bounds.x_max_m)
        corners[k, 1] = min(max(y, bounds.y_min_m), bounds.y_max_m)
        corners[k, 2] = min(max(even, low), highest)
    return corners
