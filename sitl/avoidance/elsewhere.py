"""Where a vehicle will be that flies no path: on a circle or on its way there, or straight ahead."""

import math

from missions.airframe import GRAVITY_M_S2
from sitl.avoidance.intent import GROUNDED, KEEPS, POINTS, STEP_S, Point
from sitl.flight import Flight, ground_velocity
from sitl.guidance.loiter_law import Loiter, loiter_accelerations
from sitl.guidance.path_law import TAN_LATERAL_LIMIT, clamp
from sitl.stages.circle import CircleStage

CLIMB_M_S, SINK_M_S = 3.0, 3.0
"""Taken for one on its way to a circle at another altitude."""
LATERAL_M_S2 = GRAVITY_M_S2 * TAN_LATERAL_LIMIT
PACE_S = 1.0
"""Of the steps in which a circle is foreseen."""


def off_path(flight: Flight, stage: object) -> tuple[int, tuple[Point, ...]]:
    """Status and places of a vehicle in the air."""
    if isinstance(stage, CircleStage):
        if stage.complete:
            return GROUNDED, ()
        return KEEPS, _round(flight, stage.loiter)
    return KEEPS, _straight(flight)


def _straight(flight: Flight) -> tuple[Point, ...]:
    air = flight.air
    east, north, up = ground_velocity(flight)
    return tuple(
        (air.x + east * t_s, air.y + north * t_s, air.h + up * t_s) for t_s in (i * STEP_S for i in range(POINTS))
    )


def _round(flight: Flight, loiter: Loiter) -> tuple[Point, ...]:
    """As its guidance would have it, at the ground speed that it has now."""
    air = flight.air
    east, north, _ = ground_velocity(flight)
    x, y, course, speed = air.x, air.y, math.atan2(north, east), math.hypot(east, north)
    points = [(x, y, air.h)]
    for i in range(1, POINTS):
        for _ in range(round(STEP_S / PACE_S)):
            velocity = (speed * math.cos(course), speed * math.sin(course), 0.0)
            left = loiter_accelerations((x, y, loiter.z_m), velocity, air.V, air.V, loiter).left
            course += clamp(left, -LATERAL_M_S2, LATERAL_M_S2) / speed * PACE_S
            x, y = x + speed * math.cos(course) * PACE_S, y + speed * math.sin(course) * PACE_S
        t_s = i * STEP_S
        points.append((x, y, air.h + clamp(loiter.z_m - air.h, -SINK_M_S * t_s, CLIMB_M_S * t_s)))
    return tuple(points)
