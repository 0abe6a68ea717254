"""Climb-outs and circles as references: a turn, straight to a circle's tangent, then round it, climbing or sinking.

Nearly what an endpoint's guidance does there, which follows no path; wind is left out.
"""

import math
from itertools import pairwise

import numpy as np

from missions.airframe import GRAVITY_M_S2, drag_n, thrust_max_n
from missions.reference import FilletedPath, Reference
from missions.reference.lead_in import end_of as end_of_arc
from missions.reference.lead_in import turn_towards
from missions.reference.reference import fillet_radius_m
from missions.scenario import Scenario
from sitl.guidance.loiter_law import Loiter
from sitl.itinerary import Start
from sitl.stages.circle import ON_CIRCLE, Until

Row = tuple[float, float, float, float, float]
"""A segment: arc length at its start, x, y, heading, curvature."""
LEAST_M = 1.0
LEAST_SLOPE = 0.01


def slopes_m(scenario: Scenario, speed_m_s: float) -> tuple[float, float]:
    """Steepest descent (negative) and climb, dz over distance, with all the power there is or none."""
    airframe = scenario.airframe.airframe()
    weight_n = airframe.mass_kg * GRAVITY_M_S2
    drag = drag_n(speed_m_s, weight_n, airframe) / weight_n
    spare = thrust_max_n(speed_m_s, airframe) / weight_n - drag
    by_power = math.tan(math.asin(min(max(spare, LEAST_SLOPE), 0.9)))
    return -min(-airframe.climb_rate_min_m_s / speed_m_s, drag), min(airframe.climb_rate_max_m_s / speed_m_s, by_power)


def climbed_out(start: Start, course: float, z_m: float, seq: int, speed_m_s: float, slope: float) -> Reference:
    """Straight ahead up to an altitude, at a ground speed and a slope (dz over distance, positive)."""
    x, y, z = start.position_m
    length_m = max((z_m - z) / slope, LEAST_M)
    end = (x + length_m * math.cos(course), y + length_m * math.sin(course), z_m)
    rows = [(0.0, x, y, course, 0.0)]
    return _reference(rows, length_m, [(0.0, z), (length_m, z_m)], seq, speed_m_s, end, 0.0)


def circled(
    start: Start, loiter: Loiter, seq: int, speed_m_s: float, slopes: tuple[float, float], until: Until | None
) -> Reference:
    """To a circle and round it.

    Args:
        start: from where.
        loiter: the circle.
        seq: its mission item.
        speed_m_s: over ground.
        slopes: steepest descent (negative) and climb.
        until: how long round; None for not at all, to where the circle begins.
    """
    rows, way_m = _way_in(start, loiter, speed_m_s)
    z = start.position_m[2]
    rise = loiter.z_m - z
    changing_m = rise / slopes[0 if rise < 0.0 else 1]
    if rise < 0.0:
        changing_m = max(changing_m, way_m)  # it glides down evenly on the way there
    length_m = max(way_m + _round_m(until, loiter.radius_m, speed_m_s, changing_m - way_m), LEAST_M)
    end_z = z + rise * (min(length_m / changing_m, 1.0) if changing_m else 1.0)
    heights = [(0.0, z), (min(changing_m, length_m), end_z), (length_m, end_z)]
    at = rows[-1][3] - loiter.turn * 0.5 * math.pi + loiter.turn * (length_m - way_m) / loiter.radius_m
    end = (loiter.x_m + loiter.radius_m * math.cos(at), loiter.y_m + loiter.radius_m * math.sin(at), end_z)
    return _reference(rows, length_m, heights, seq, speed_m_s, end, -loiter.turn * loiter.radius_m)


def _way_in(start: Start, loiter: Loiter, speed_m_s: float) -> tuple[list[Row], float]:
    """A turn, straight to the tangent, and the circle, as segments; and where the circle begins."""
    x, y, _ = start.position_m
    rows: list[Row] = []
    way_m = 0.0
    if start.course is not None and math.hypot(x - loiter.x_m, y - loiter.y_m) > loiter.radius_m:
        arc = turn_towards(x, y, start.course, _tangent(x, y, loiter)[1:], fillet_radius_m(speed_m_s))
        if arc.length_m > 0.0:
            rows.append((0.0, x, y, start.course, arc.curvature))
            x, y = end_of_arc(arc)
            way_m = arc.length_m
    at, on_x, on_y = _tangent(x, y, loiter)
    if (straight_m := math.hypot(on_x - x, on_y - y)) > 0.0:
        rows.append((way_m, x, y, math.atan2(on_y - y, on_x - x), 0.0))
        way_m += straight_m
    rows.append((way_m, on_x, on_y, at + loiter.turn * 0.5 * math.pi, loiter.turn / loiter.radius_m))
    return rows, way_m


def _tangent(x_m: float, y_m: float, loiter: Loiter) -> tuple[float, float, float]:
    """Where a straight way meets the circle: bearing from its centre, x, y; from inside, the nearest point of it."""
    away = math.hypot(x_m - loiter.x_m, y_m - loiter.y_m)
    at = math.atan2(y_m - loiter.y_m, x_m - loiter.x_m)
    at += loiter.turn * math.acos(min(loiter.radius_m / max(away, 1e-9), 1.0))
    return at, loiter.x_m + loiter.radius_m * math.cos(at), loiter.y_m + loiter.radius_m * math.sin(at)


def _round_m(until: Until | None, radius_m: float, speed_m_s: float, to_altitude_m: float) -> float:
    """How far round. Time and turns count from where an endpoint takes it that it has arrived: before the tangent."""
    if until is None:
        return 0.0
    if until.altitude:
        return max(to_altitude_m, 0.0)
    before_m = radius_m * math.sqrt((1.0 + ON_CIRCLE) ** 2 - 1.0)
    before_turned = math.acos(1.0 / (1.0 + ON_CIRCLE))
    by_time = until.time_s * speed_m_s - before_m
    by_turns = radius_m * (2.0 * math.pi * until.turns - before_turned)
    return max(min(by_time, by_turns), 0.0)


def end_of(reference: Reference) -> Start:
    """Where a reference ends, and its course there."""
    end = reference.path.at(np.array(reference.length_m))
    z_m = float(reference.points(np.array(reference.length_m))[2])
    return Start((float(end[0]), float(end[1]), z_m), float(end[2]))


def _reference(
    rows: list[Row],
    length_m: float,
    heights: list[tuple[float, float]],
    seq: int,
    speed_m_s: float,
    end_m: tuple[float, float, float],
    radius_m: float,
) -> Reference:
    altitude = [
        [s, z, (next_z - z) / (next_s - s), 0.0] for (s, z), (next_s, next_z) in pairwise(heights) if next_s > s
    ]
    return Reference(
        path=FilletedPath(np.array(rows), length_m, np.array([0.0, length_m]), np.full(2, math.inf), np.zeros(2)),
        altitude=np.array(altitude),
        schedule=np.array([[0.0, 0.0, speed_m_s, 0.0]]),
        duration_s=length_m / speed_m_s,
        corner_seq=(seq, seq),
        corner_time_s=np.array([0.0, length_m / speed_m_s]),
        leg_airspeed_m_s=np.array([speed_m_s]),
        leg_ground_speed_m_s=np.array([speed_m_s]),
        leg_slope=np.array([(end_m[2] - heights[0][1]) / length_m]),
        target_m=end_m,
        loiter_radius_m=radius_m,
        loiter_z_m=end_m[2],
    )
