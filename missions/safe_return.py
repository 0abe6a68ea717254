"""How high a vehicle must be to come home in a straight line from anywhere on its way."""

import numpy as np
import numpy.typing as npt

from missions.environment import Environment, ground_heights_m

FloatArray = npt.NDArray[np.float64]

_PARTS = 200
"""Of each line home, between which the ground is not looked at."""


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
    home = np.asarray(home_m[:2])
    ways = way_m[:, :2] - home
    part = np.linspace(0.0, 1.0, _PARTS + 1)[:, np.newaxis, np.newaxis]
    lines = home + part * ways
    highest = float(ground_heights_m(lines[..., 0], lines[..., 1], environment.terrain).max())
    for obstacle in environment.obstacles:
        axis = np.array([obstacle.x_m, obstacle.y_m]) - home
        nearest = np.clip(ways @ axis / np.maximum((ways**2).sum(axis=1), 1e-9), 0.0, 1.0)
        distance_m = np.hypot(*(nearest[:, np.newaxis] * ways - axis).T).min()
        if distance_m < obstacle.radius_m + obstacle_margin_m:
            highest = max(highest, obstacle.top_m)
    return max(highest, home_m[2]) + clearance_m
