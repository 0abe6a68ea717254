"""Everything in the mission area that a path must mind."""

from dataclasses import dataclass

from missions.environment.area import Area
from missions.environment.obstacles import Obstacle
from missions.environment.radars import Radar
from missions.environment.terrain import Terrain


@dataclass(frozen=True)
class Environment:
    """The mission area as geometry, local frame, metres."""

    area: Area
    terrain: Terrain
    radars: tuple[Radar, ...]
    obstacles: tuple[Obstacle, ...]
