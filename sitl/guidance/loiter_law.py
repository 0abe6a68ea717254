"""Circling a point: wanted accelerations of a loiter."""

import math
from typing import NamedTuple

from sitl.guidance.path_law import Accelerations, speed_acceleration, up_acceleration

COURSE_GAIN = 0.5
"""1/s, from course error to course rate."""
FAR = 1.5
"""Farther than this many radii outside the circle it is approached straight along a tangent."""


class Loiter(NamedTuple):
    """A circle to fly: centre and altitude in the local frame, metres; `turn` is +1 anticlockwise, -1 clockwise."""

    x_m: float
    y_m: float
    z_m: float
    radius_m: float
    turn: float


class Approach(NamedTuple):
    """Where the way to a circle began: altitude, and distance from the circle's rim, metres."""

    z_m: float
    to_go_m: float


def from_centre_m(x_m: float, y_m: float, loiter: Loiter) -> float:
    """Distance from the centre."""
    dx = x_m - loiter.x_m
    dy = y_m - loiter.y_m
    return math.sqrt(dx * dx + dy * dy)


def to_go_m(x_m: float, y_m: float, loiter: Loiter) -> float:
    """Distance from the rim; 0 inside."""
    return max(from_centre_m(x_m, y_m, loiter) - loiter.radius_m, 0.0)


def on_approach(x_m: float, y_m: float, loiter: Loiter, approach: Approach) -> Loiter:
    """The circle at the altitude to hold now: it climbs at once, and glides down on the way there."""
    if approach.z_m <= loiter.z_m or approach.to_go_m <= 0.0:
        return loiter
    share = min(to_go_m(x_m, y_m, loiter) / approach.to_go_m, 1.0)
    z_m = loiter.z_m + share * (approach.z_m - loiter.z_m)
    return Loiter(loiter.x_m, loiter.y_m, z_m, loiter.radius_m, loiter.turn)


def loiter_accelerations(
    position: tuple[float, float, float],
    ground_velocity: tuple[float, float, float],
    airspeed: float,
    airspeed_wanted: float,
    loiter: Loiter,
) -> Accelerations:
    """Turn towards the tangent of the circle, bent inwards or outwards by the distance from it; hold its altitude."""
    dx = position[0] - loiter.x_m
    dy = position[1] - loiter.y_m
    distance = math.sqrt(dx * dx + dy * dy)
    away = math.atan2(dy, dx)
    course = math.atan2(ground_velocity[1], ground_velocity[0])
    speed = math.sqrt(ground_velocity[0] * ground_velocity[0] + ground_velocity[1] * ground_velocity[1])
    offset = max((distance - loiter.radius_m) / loiter.radius_m, -1.0)
    if offset > FAR:
        wanted = away + loiter.turn * (math.pi - math.asin(loiter.radius_m / distance))
    else:
        wanted = away + loiter.turn * (0.5 * math.pi + math.atan(2.0 * offset))
    turn_by = math.atan2(math.sin(wanted - course), math.cos(wanted - course))
    circling = loiter.turn * speed / loiter.radius_m if abs(offset) < 0.5 else 0.0
    return Accelerations(
        speed_acceleration(airspeed_wanted, airspeed),
        speed * (COURSE_GAIN * turn_by + circling),
        up_acceleration(position[2] - loiter.z_m, ground_velocity[2], 0.0),
        course,
    )
