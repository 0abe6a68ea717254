"""On which side of each threat a path passes: its homotopy class, more or less; and the same path on another side.

The local optima of a path are, nearly, one a class: a search over classes with a descent in each is one over all.
"""

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from missions.compiled import jit
from planner.cost.problem import PathProblem
from planner.skein.routes import RouteGrid
from planner.skein.starts import path_along, spacing

FloatArray = npt.NDArray[np.float64]

LEFT, RIGHT, ABOVE, BELOW = range(4)
TOUCHING_M = 60.0
"""A path this near to what it must keep may want to pass on another side."""
REACH = 1.6
"""Half of the length of path that is led over or under a radar, in radii."""
WALL_M = 1e6
"""Length of the wall that closes the side on which a threat is passed: to the edge of the area."""


def threats(problem: PathProblem) -> FloatArray:
    """(n, 5) centre x, y, z, half width and half height of what a path goes round: radars, then obstacles; metres."""
    radars = [(x, y, z, radius, radius) for x, y, z, radius, _ in problem.radars]
    obstacles = [(x, y, 0.0, radius + keep, top + keep) for x, y, radius, top, keep in problem.obstacles]
    return np.array(radars + obstacles, dtype=np.float64).reshape(-1, 5)


@jit
def sides(corners: Any, around: Any, out: Any) -> None:
    """Fill in the side of (n + 1, 3) corners on which each threat is passed."""
    for i in range(len(around)):
        least = math.inf
        for k in range(len(corners) - 1):
            p, q = corners[k], corners[k + 1]
            dx, dy = q[0] - p[0], q[1] - p[1]
            cx, cy = around[i, 0] - p[0], around[i, 1] - p[1]
            length2 = dx * dx + dy * dy
            t = min(1.0, max(0.0, (cx * dx + cy * dy) / length2)) if length2 > 0.0 else 0.0
            x, y, z = cx - t * dx, cy - t * dy, around[i, 2] - p[2] - t * (q[2] - p[2])
            beside2 = x * x + y * y
            if beside2 >= least:
                continue
            least = beside2
            out[i] = LEFT if dx * y - dy * x < 0.0 else RIGHT
            if z * z * around[i, 3] * around[i, 3] > beside2 * around[i, 4] * around[i, 4]:
                out[i] = ABOVE if z < 0.0 else BELOW


def classes(paths: Sequence[FloatArray] | FloatArray, around: FloatArray) -> list[bytes]:
    """The class of each of (n, m, 3) paths."""
    out = np.zeros((len(paths), len(around)), dtype=np.int8)
    for path, row in zip(paths, out, strict=True):
        sides(path, around, row)
    return [row.tobytes() for row in out]


def on_other_sides(
    corners_m: FloatArray, problem: PathProblem, around: FloatArray, grid: RouteGrid, rng: np.random.Generator
) -> list[FloatArray]:
    """Paths that pass one threat which this one touches on its other side: along the best route there, and, by a radar,
    over and under it where there is room."""
    found = []
    p, q = corners_m[:-1], corners_m[1:]
    leg = q - p
    length2 = np.maximum(np.sum(leg[:, :2] ** 2, axis=1), 1e-6)
    passed = np.append(0.0, np.cumsum(np.sqrt(length2)))
    for i, (x, y, z, wide, high) in enumerate(around):
        t = np.clip(((x - p[:, 0]) * leg[:, 0] + (y - p[:, 1]) * leg[:, 1]) / length2, 0.0, 1.0)
        nearest = p + t[:, None] * leg
        away = np.hypot(nearest[:, 0] - x, nearest[:, 1] - y)
        k = int(np.argmin(away))
        off = nearest[k] - (x, y, z)
        is_radar = i < len(problem.radars)
        beyond = float(np.linalg.norm(off)) if is_radar else float(away[k])
        if beyond > wide + TOUCHING_M or (not is_radar and off[2] > high):
            continue
        across = off[:2] / max(float(away[k]), 1e-6)
        wall = np.array([[x, y], [x, y]]) + np.outer([-0.2 * wide, WALL_M], across)
        found.append(path_along(grid.route(wall_m=wall), spacing(len(corners_m) - 2, rng), problem))
        if is_radar:
            half = REACH * wide + passed[-1] / len(leg)
            there = passed[k] + t[k] * np.sqrt(length2[k])
            bump = np.cos(0.5 * np.pi * np.clip((passed - there) / half, -1.0, 1.0)) ** 2
            bump[[0, -1]] = 0.0
            for side in (-1.0, 1.0):
                if off[2] * side < 0.9 * high and problem.bounds.z_min_m < z + side * high < problem.bounds.z_max_m:
                    path = corners_m.copy()
                    path[:, 2] += bump * (side * 1.05 * high - off[2])
                    found.append(path)
    return found
