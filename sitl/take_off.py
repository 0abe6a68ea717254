"""The launch in mode TAKEOFF: into the wind, or as near to it as the terrain lets."""

import math

from missions.environment.terrain import ground_height_m
from sitl.config import VehicleConfig
from sitl.flight import LAUNCH_SLOPE, Vector
from sitl.stages.straight import ClimbOutStage

CALM_M_S = 1.0
"""Below, there is no wind to head into."""
AHEAD_M = 2000.0
STEP_M = 50.0
TURNS_DEG = (0, 30, -30, 60, -60, 90, -90, 120, -120, 150, -150, 180)


def climb_out(here_m: Vector, z_m: float, config: VehicleConfig) -> ClimbOutStage:
    """Straight up to an altitude, on the first course off the wind that has no higher ground ahead."""
    east, north = config.steady_wind_m_s
    into_wind = math.atan2(-north, -east) if math.hypot(east, north) > CALM_M_S else 0.0
    courses = [into_wind + math.radians(turn) for turn in TURNS_DEG]
    best = min(courses, key=lambda course: max(_in_the_way_m(here_m, course, config), 0.0))
    return ClimbOutStage(math.remainder(best, 2.0 * math.pi), z_m)


def _in_the_way_m(here_m: Vector, course: float, config: VehicleConfig) -> float:
    """How far the ground ahead rises over the climb."""
    x, y, z = here_m
    steps = [STEP_M * i for i in range(1, round(AHEAD_M / STEP_M) + 1)]
    cos_course, sin_course = math.cos(course), math.sin(course)
    return max(
        ground_height_m(x + s * cos_course, y + s * sin_course, config.terrain) - z - LAUNCH_SLOPE * s for s in steps
    )
