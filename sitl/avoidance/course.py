"""Where a vehicle on its path will be: its schedule, its lead on that, and what it does to give way.

In the dialect that plain Python and numba compute bit for bit alike.
"""

from typing import Any, NamedTuple

from missions.reference.path import path_at
from missions.reference.reference import ReferenceTables
from missions.reference.smoothing import quadratic_at
from sitl.avoidance.intent import STEP_S
from sitl.guidance.path_errors import PathErrors, PathPoint, ScheduleClock
from sitl.guidance.path_law import clamp

LAG_S = 2.5
"""So much later a new speed or climb rate begins to tell: the law's and the actuators' delay."""
SLOWEST_M_S = 5.0
"""No schedule is slower; keeps the search for a time finite."""


class Situation(NamedTuple):
    """One vehicle on its path at one tick.

    Attributes:
        position, errors, point: of the aircraft.
        airspeed, airspeed_wanted: that it has, and that is commanded there.
        clock: of its schedule.
        end_s_m: arc length at which its path ends.
        follows: it keeps its schedule; otherwise it holds an airspeed.
        tables: of its path.
    """

    position: tuple[float, float, float]
    errors: PathErrors
    point: PathPoint
    airspeed: float
    airspeed_wanted: float
    clock: ScheduleClock
    end_s_m: float
    follows: bool
    tables: ReferenceTables


class Pace(NamedTuple):
    """How it goes along its path, and above it.

    Attributes:
        time_s, rate, lead_m: of its schedule's clock, and how far it is ahead of that, now.
        drift_m_s: how the lead changes by itself; one that `settles` goes to 0 and stays there.
        speed_m_s, most_ahead_m: what it flies faster to give way, until so much has come of it.
        raised_m, climb_m_s, most_up_m: how far above its path it is to be, how that changes, and up to what.
    """

    time_s: float
    rate: float
    lead_m: float
    drift_m_s: float
    settles: bool
    speed_m_s: float
    most_ahead_m: float
    raised_m: float
    climb_m_s: float
    most_up_m: float


def lead_in(t_s: float, pace: Pace) -> float:
    """How far ahead of its schedule it is after some time."""
    lead = pace.lead_m + pace.drift_m_s * t_s
    if pace.settles and lead * pace.lead_m <= 0.0:
        lead = 0.0
    gained = pace.speed_m_s * max(t_s - LAG_S, 0.0)
    return lead + clamp(gained, -pace.most_ahead_m, pace.most_ahead_m)


def raised_in(t_s: float, pace: Pace) -> float:
    """How far above its path it is after some time."""
    return clamp(pace.raised_m + pace.climb_m_s * max(t_s - LAG_S, 0.0), 0.0, pace.most_up_m)


def predict(pace: Pace, now: Situation, most: int, points: Any) -> int:
    """Put into `points` where it is now and will be, every STEP_S; returns how many lie on its path, of that many."""
    points[0][0], points[0][1], points[0][2] = now.position
    segment, altitude_piece, schedule_piece = now.point.segment, now.point.altitude_piece, now.point.schedule_piece
    tables = now.tables
    for i in range(1, most):
        t_s = i * STEP_S
        s, _, _, schedule_piece = quadratic_at(pace.time_s + pace.rate * t_s, schedule_piece, tables.schedule)
        s += lead_in(t_s, pace)
        if s >= now.end_s_m:
            return i
        x, y, _, _, segment = path_at(s, segment, tables.segments)
        z, _, _, altitude_piece = quadratic_at(s, altitude_piece, tables.altitude)
        points[i][0], points[i][1], points[i][2] = x, y, z + raised_in(t_s, pace)
    return most


def scheduled_at(now: Situation) -> tuple[float, float]:
    """When its schedule is where it is, and how fast that is there."""
    time_s, piece = now.clock.time_s, now.point.schedule_piece
    s, rate, _, piece = quadratic_at(time_s, piece, now.tables.schedule)
    for _ in range(4):
        time_s += (now.point.s_m - s) / max(rate, SLOWEST_M_S)
        s, rate, _, piece = quadratic_at(time_s, piece, now.tables.schedule)
    return time_s, rate
