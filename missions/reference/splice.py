"""Two references made into one: along the first, straight across, and on along the second."""

import numpy as np
import numpy.typing as npt

from missions.reference.path import SHORTEST_LEG_M, FilletedPath, fillet
from missions.reference.reference import ALTITUDE_WINDOW_M, SCHEDULE_WINDOW_S, Reference
from missions.reference.smoothing import moving_average, quadratics_at
from missions.reference.wind_triangle import airspeed_on_track

FloatArray = npt.NDArray[np.float64]

EVEN = 1e-9
"""A quadratic piece that bends no more than this, in its units, counts as a line."""
RADIUS_TOLERANCE = 0.01
"""Arcs this much tighter than asked for found no room."""


def spliced(
    own: Reference,
    other: Reference,
    start_s: float,
    end_s: float,
    radius_m: float,
    forecast_wind_m_s: tuple[float, float],
) -> Reference:
    """Fly `own` until one time and `other` from a later one on, both counted from the launch; straight ahead between.

    Table rows that hold before the change, and `other`'s positions over time after it, stay what they were. The corners
    at which the change begins and ends have the mission item of `other` that comes after them.

    Args:
        own, other: what is flown before and after.
        start_s, end_s: when one is left, and when the other is reached.
        radius_m: of the arcs into and out of the leg between.
        forecast_wind_m_s: turns that leg's ground speed into an airspeed.

    Raises:
        ValueError: one of the two is turning, climbing otherwise, or changing its speed there, or arcs find no room.
    """
    ends_s = np.array([start_s, end_s])
    s_a, s_b = float(own.arc_lengths(ends_s[:1])[0]), float(other.arc_lengths(ends_s[1:])[0])
    path, shift_m, (at_a, at_b) = _across(own.path, other.path, s_a, s_b, radius_m)
    altitude = _joined(own.altitude, other.altitude, (at_a, at_b), (shift_m, 0.0), ALTITUDE_WINDOW_M)
    schedule = _joined(own.schedule, other.schedule, (start_s, end_s), (0.0, shift_m), SCHEDULE_WINDOW_S)

    before = int(np.searchsorted(own.path.corner_s_m, at_a))
    after = int(np.searchsorted(other.path.corner_s_m, at_b - shift_m, side="right"))
    slope = float(np.diff(quadratics_at(np.array([at_a, at_b]), altitude)[0])[0]) / (at_b - at_a)
    ground = (s_b + shift_m - s_a) / (end_s - start_s)
    heading = float(path.at(np.array((at_a + at_b) / 2))[2])
    airspeed = airspeed_on_track(ground, slope, heading, forecast_wind_m_s)

    def legs(first: FloatArray, middle: float, last: FloatArray) -> FloatArray:
        return np.concatenate([first[:before], [middle], last[after - 1 :]])

    return Reference(
        path=path,
        altitude=altitude,
        schedule=schedule,
        duration_s=other.duration_s,
        corner_seq=own.corner_seq[:before] + 2 * (other.corner_seq[after],) + other.corner_seq[after:],
        corner_time_s=np.concatenate([own.corner_time_s[:before], ends_s, other.corner_time_s[after:]]),
        leg_airspeed_m_s=legs(own.leg_airspeed_m_s, airspeed, other.leg_airspeed_m_s),
        leg_ground_speed_m_s=legs(own.leg_ground_speed_m_s, ground, other.leg_ground_speed_m_s),
        leg_slope=legs(own.leg_slope, slope, other.leg_slope),
        target_m=other.target_m,
        loiter_radius_m=other.loiter_radius_m,
        loiter_z_m=other.loiter_z_m,
    )


def _across(
    own: FilletedPath, other: FilletedPath, s_a: float, s_b: float, radius_m: float
) -> tuple[FilletedPath, float, tuple[float, float]]:
    """The path with a straight leg from one to the other; what arc lengths on the other grow by; and those at which
    the leg begins and ends, in the middles of its arcs."""
    row, next_row = _straight(own, s_a), _straight(other, s_b) + 1
    corners = np.array(
        [
            own.segments[row, 1:3],
            np.stack(own.at(np.array(s_a))[:2]),
            np.stack(other.at(np.array(s_b))[:2]),
            other.segments[next_row, 1:3],
        ]
    )
    if np.hypot(*np.diff(corners, axis=0).T).min() < SHORTEST_LEG_M:
        raise ValueError("is turning there")
    link = fillet(corners, radius_m)
    if link.corner_radius_m[1:3].min() < radius_m * (1.0 - RADIUS_TOLERANCE):
        raise ValueError("there is no room to turn there")
    start_m = float(own.segments[row, 0])
    shift_m = start_m + link.length_m - float(other.segments[next_row, 0])
    middle, rest = link.segments[1:-1].copy(), other.segments[next_row:].copy()
    middle[:, 0] += start_m
    rest[:, 0] += shift_m
    at_a, at_b = (start_m + link.corner_s_m[1:3]).tolist()
    before = int(np.searchsorted(own.corner_s_m, at_a))
    after = int(np.searchsorted(other.corner_s_m, at_b - shift_m, side="right"))

    def corners_of(first: FloatArray, between: FloatArray, last: FloatArray) -> FloatArray:
        return np.concatenate([first[:before], between, last[after:]])

    path = FilletedPath(
        segments=np.vstack([own.segments[: row + 1], middle, rest]),
        length_m=other.length_m + shift_m,
        corner_s_m=corners_of(own.corner_s_m, np.array([at_a, at_b]), other.corner_s_m + shift_m),
        corner_radius_m=corners_of(own.corner_radius_m, link.corner_radius_m[1:3], other.corner_radius_m),
        corner_turn=corners_of(own.corner_turn, link.corner_turn[1:3], other.corner_turn),
    )
    return path, shift_m, (at_a, at_b)


def _straight(path: FilletedPath, s_m: float) -> int:
    """The segment at an arc length. Raises ValueError when it is an arc, or lies past the end."""
    row = int(np.searchsorted(path.segments[:, 0], s_m, side="right")) - 1
    if row < 0 or row + 1 == len(path.segments) or path.segments[row, 4] != 0.0:
        raise ValueError("is turning there")
    return row


def _joined(
    own: FloatArray, other: FloatArray, ends: tuple[float, float], shift: tuple[float, float], window: float
) -> FloatArray:
    """Quadratic pieces of `own`, from `ends[0]` of a line, from `ends[1]` of `other`, smoothed as they are.

    Args:
        own, other: pieces (m, 4).
        ends: where the line begins and ends.
        shift: what `other`'s argument and value grow by.
        window: of the smoothing.

    Raises:
        ValueError: one of the two is not a line within half a window before or after that.
    """
    moved = other + np.array([shift[0], shift[1], 0.0, 0.0])
    begin, end = ends[0] - window / 2, ends[1] + window / 2
    for pieces, low, high in ((own, begin, ends[0]), (moved, ends[1], end)):
        first, last = np.maximum(np.searchsorted(pieces[:, 0], [low, high], side="right") - 1, 0)
        if first != last or abs(pieces[first, 3]) > EVEN:
            raise ValueError("changes its climb or its speed there")
    (value_a,), (slope_a,) = quadratics_at(np.array(ends[:1]), own)
    (value_b,), (slope_b,) = quadratics_at(np.array(ends[1:]), moved)
    knots = np.array([ends[0] - window, *ends, ends[1] + window])
    values = np.array([value_a - window * slope_a, value_a, value_b, value_b + window * slope_b])
    between = moving_average(knots, values, window)
    return np.vstack([own[own[:, 0] < begin], between[1:], moved[moved[:, 0] > end]])
