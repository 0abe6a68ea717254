"""How high a vehicle must be to come home in a straight line from anywhere on its way."""

import numpy as np
import numpy.typing as npt

from missions.environment import Environment, ground_heights_m
from missions.environment.obstacles import wall_distances_m

FloatArray = npt.NDArray[np.float64]

_PARTS = 200
"""Points on each line home."""


def safe_return_altitude_m(
    home_m: tuple[float, float, float],
    way_m: FloatArray,
    environment: Environment,
    clearance_m: float,
    obstacle_margin_m: float,
) -> float:
    """The lowest altitude above the datum, in metres, at which all straight lines home are clear.

    Args:
        home_m: (x, y, z) of home, local frame.
        way_m: (n, 3) points of the way, local frame.
        environment: ground and obstacles.
        clearance_m: above the ground and above obstacles.
        obstacle_margin_m: beside an obstacle's wall, within which it counts.
    """
    home = np.asarray(home_m)
    part = np.linspace(0.0, 1.0, _PARTS + 1)[:, np.newaxis, np.newaxis]
    lines = home + part * (way_m - home)
    highest = float(ground_heights_m(lines[..., 0], lines[..., 1], environment.terrain).max())
    for obstacle in environment.obstacles:
        level = lines.copy()
        level[..., 2] = obstacle.top_m
        spacing_m = np.hypot(*(way_m - home)[:, :2].T) / _PARTS
        if (wall_distances_m(level, obstacle) < obstacle_margin_m + spacing_m / 2).any():
            highest = max(highest, obstacle.top_m)
    return max(highest, home_m[2]) + clearance_m
