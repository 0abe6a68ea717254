"""Where an aircraft is beside its reference: the deviations of MODEL, section 6."""

import math
from typing import NamedTuple

from missions.reference.path import path_at
from missions.reference.reference import ReferenceTables
from missions.reference.smoothing import quadratic_at


class PathPoint(NamedTuple):
    """The aircraft's projection on its path: arc length, and where in the tables it was found."""

    s_m: float
    segment: int
    altitude_piece: int
    schedule_piece: int


START = PathPoint(0.0, 0, 0, 0)


class ScheduleClock(NamedTuple):
    """What the clock of a schedule shows.

    Attributes:
        time_s: since its beginning.
        rate: of the clock, 1 unless the schedule slows down.
        change: of the rate, 1/s.
    """

    time_s: float
    rate: float
    change: float


class PathErrors(NamedTuple):
    """Deviations from the reference, SI and radians.

    Attributes:
        along, along_rate: e = s - s_ref and e' = v_t / (1 - kappa e_n) - s_ref'.
        across, above: e_n (positive left of the path) and e_h.
        v_t, v_n, v_z: ground velocity along, left of and above the path's heading.
        heading, curvature, slope: of the path there; slope is dz/ds.
        reference_acceleration: s_ref'', by time as it passes.
    """

    along: float
    along_rate: float
    across: float
    above: float
    v_t: float
    v_n: float
    v_z: float
    heading: float
    curvature: float
    slope: float
    reference_acceleration: float


def path_errors(
    position: tuple[float, float, float],
    ground_velocity: tuple[float, float, float],
    clock: ScheduleClock,
    point: PathPoint,
    tables: ReferenceTables,
) -> tuple[PathErrors, PathPoint]:
    """Deviations at a time of the schedule, by one Newton step of the projection from the last tick's point."""
    x, y, heading, curvature, segment = path_at(point.s_m, point.segment, tables.segments)
    cos_heading = math.cos(heading)
    sin_heading = math.sin(heading)
    dx = position[0] - x
    dy = position[1] - y
    across = dy * cos_heading - dx * sin_heading
    # Inside a tight corner the projection is not unique; the floor keeps the step finite there.
    step = (dx * cos_heading + dy * sin_heading) / max(1.0 - curvature * across, 0.2)
    s = point.s_m + step
    heading = heading + curvature * step
    cos_heading = math.cos(heading)
    sin_heading = math.sin(heading)
    v_t = ground_velocity[0] * cos_heading + ground_velocity[1] * sin_heading
    v_n = ground_velocity[1] * cos_heading - ground_velocity[0] * sin_heading
    z, slope, _, altitude_piece = quadratic_at(s, point.altitude_piece, tables.altitude)
    s_ref, s_ref_rate, s_ref_acceleration, schedule_piece = quadratic_at(
        clock.time_s, point.schedule_piece, tables.schedule
    )
    errors = PathErrors(
        s - s_ref,
        v_t / max(1.0 - curvature * across, 0.2) - s_ref_rate * clock.rate,
        across,
        position[2] - z,
        v_t,
        v_n,
        ground_velocity[2],
        heading,
        curvature,
        slope,
        s_ref_acceleration * clock.rate * clock.rate + s_ref_rate * clock.change,
    )
    return errors, PathPoint(s, segment, altitude_piece, schedule_piece)
