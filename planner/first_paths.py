"""The paths a search begins with: the straight line, bent smoothly at random."""

import numpy as np
import numpy.typing as npt

from planner.cost.problem import PathProblem

FloatArray = npt.NDArray[np.float64]

WAVES = 3
"""Half waves of the shortest bend along the line."""
SIDEWAYS = 0.08
"""Typical sideways bend, in lengths of the line."""


def first_paths(problem: PathProblem, waypoints: int, population: int, rng: np.random.Generator) -> FloatArray:
    """(population, 3 waypoints) interior waypoints of first paths, evenly spaced along the line.

    The first is the straight line itself. Vertical bends use the slope that the limits leave beside the line's own.
    """
    part = np.linspace(0.0, 1.0, waypoints + 2)[1:-1]
    origin, target, bounds = problem.origin_m, problem.target_m, problem.bounds
    along = target - origin
    distance = float(np.hypot(along[0], along[1]))
    left = np.array([-along[1], along[0]]) / distance
    slope = along[2] / distance
    spare_slope = max(0.0, min(bounds.slope_max - slope, slope - bounds.slope_min))

    wave = np.arange(1, WAVES + 1)
    shapes = np.sin(np.pi * wave[:, None] * part)
    sideways = rng.normal(size=(population, WAVES)) * SIDEWAYS * distance / wave
    upwards = rng.uniform(-1.0, 1.0, (population, WAVES)) * spare_slope * distance / (np.pi * wave * WAVES)
    sideways[0] = upwards[0] = 0.0
    paths = origin + part[:, None] * along + np.zeros((population, 1, 1))
    paths[:, :, :2] += (sideways @ shapes)[:, :, None] * left
    paths[:, :, 2] += upwards @ shapes
    low, high = box(problem)
    flat: FloatArray = np.clip(paths, low, high).reshape(population, -1)
    return flat


def box(problem: PathProblem) -> tuple[FloatArray, FloatArray]:
    """Lowest and highest coordinates of a waypoint (1)."""
    b = problem.bounds
    return np.array([b.x_min_m, b.y_min_m, b.z_min_m]), np.array([b.x_max_m, b.y_max_m, b.z_max_m])
