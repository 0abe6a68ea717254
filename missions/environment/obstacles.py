"""Obstacles: vertical cylinders that stand on the ground (the paper's tall buildings)."""

from typing import NamedTuple

import numpy as np
import numpy.typing as npt


class Obstacle(NamedTuple):
    """A solid cylinder from below the ground up to `top_m` above the datum, local frame, metres."""

    x_m: float
    y_m: float
    radius_m: float
    top_m: float


def wall_distances_m(points_m: npt.NDArray[np.float64], obstacle: Obstacle) -> npt.NDArray[np.float64]:
    """Distance of points (..., 3) from the cylinder's surface, metres; 0 inside. Shape (...)."""
    beside = np.hypot(points_m[..., 0] - obstacle.x_m, points_m[..., 1] - obstacle.y_m) - obstacle.radius_m
    above = points_m[..., 2] - obstacle.top_m
    return np.hypot(np.maximum(beside, 0.0), np.maximum(above, 0.0))
