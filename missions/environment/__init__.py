"""The mission area as geometry: terrain, radars and obstacles (equations (1)-(2), (7)-(10))."""

from missions.environment.area import Area
from missions.environment.environment import Environment
from missions.environment.obstacles import Obstacle
from missions.environment.radars import Radar
from missions.environment.terrain import (
    Terrain,
    ground_height_and_slope,
    ground_height_m,
    ground_heights_m,
    slope_bound,
)

__all__ = [
    "Area",
    "Environment",
    "Obstacle",
    "Radar",
    "Terrain",
    "ground_height_and_slope",
    "ground_height_m",
    "ground_heights_m",
    "slope_bound",
]
