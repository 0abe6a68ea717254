"""Turning from a course on to a point: the arc after which the point lies straight ahead."""

import math

from missions.reference.path import Arc


def turn_towards(x_m: float, y_m: float, course: float, point_m: tuple[float, float], radius_m: float) -> Arc:
    """The arc of the shorter way from a place and a course to a point, by a turn and then straight ahead.

    One of the two circles beside the course never contains the point, so there always is such a way.
    """
    ways = []
    for side in (1.0, -1.0):
        centre_x = x_m - side * radius_m * math.sin(course)
        centre_y = y_m + side * radius_m * math.cos(course)
        away = math.hypot(point_m[0] - centre_x, point_m[1] - centre_y)
        # Seen from the centre: the aircraft, and the place where it leaves the circle along its tangent.
        here = course - side * 0.5 * math.pi
        leave = math.atan2(point_m[1] - centre_y, point_m[0] - centre_x)
        leave -= side * math.acos(min(radius_m / max(away, 1e-9), 1.0))
        turn = (side * (leave - here)) % (2.0 * math.pi)
        if turn > 2.0 * math.pi - 1e-9:
            turn = 0.0
        arc = Arc(x_m, y_m, course, side / radius_m, radius_m * turn)
        straight = math.sqrt(max(away * away - radius_m * radius_m, 0.0))
        ways.append((away < radius_m * (1.0 - 1e-9), arc.length_m + straight, arc))
    return min(ways, key=lambda way: way[:2])[2]


def end_of(arc: Arc) -> tuple[float, float]:
    """Where an arc ends, (x, y)."""
    turned = arc.heading + arc.curvature * arc.length_m
    return (
        arc.x_m + (math.sin(turned) - math.sin(arc.heading)) / arc.curvature,
        arc.y_m - (math.cos(turned) - math.cos(arc.heading)) / arc.curvature,
    )
