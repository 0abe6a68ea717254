"""How a vehicle gives way: slower or faster along its path, or above it; never beside it.

Its path is verified against terrain, and what is above it too. In the dialect that plain Python and numba compute bit
for bit alike.
"""

from typing import NamedTuple

from missions.airframe import GRAVITY_M_S2, Airframe, drag_n, thrust_max_n
from missions.reference.smoothing import quadratic_at
from sitl.avoidance.course import SLOWEST_M_S, Pace, Situation, scheduled_at
from sitl.avoidance.intent import FASTEST, SLOWEST
from sitl.guidance.path_errors import PathErrors
from sitl.guidance.path_law import clamp, speed_acceleration
from sitl.ticks import TICK_S

FREE, HOLD, SLOWER, FASTER, CLIMB, CLIMB_SLOWER = range(6)
"""What it does. FREE: flies as planned, or back to that. HOLD: keeps the distance to its schedule that it has."""
SPEED_ROOM_M_S = 2.0
"""Commanded airspeeds stay so far within the limits, as the planner's do."""
MOST_SPEED_M_S = 5.0
"""A vehicle that gives way is slower or faster by so much."""
MOST_CLIMB_M_S, SINK_M_S = 3.0, 2.0
"""Away from its path, and back to it."""
LEAST_M_S = 0.5
"""A speed or a climb rate below this is no way to give way."""
POWER_SHARE = 0.9
"""Of what there is, for a climb."""
RATE_GAIN = 0.4
"""1/s, from e' to acceleration."""
RETURN_M_S = 6.0
"""Closing speed of one who is back in the formation."""
SCHEDULE_SHARE, WIND_SHARE = 0.1, 0.05
"""Of the newest value in a mean, once a second."""
HEIGHTS, LENGTHS = 3.0, 3.0
"""Nobody goes farther from what was planned, in safe distances, above its path and along it."""


class Manoeuvre(NamedTuple):
    """What a vehicle does at a tick.

    Attributes:
        action: of those above.
        speed_m_s: that it flies faster.
        climb_m_s: that its height above the path changes by.
        raised_m: height above the path that is wanted.
        drift_m_s, surplus_m_s: see `drift_of`, `surplus_of`.
        other: row of the vehicle that it gives way to; -1 for none.
    """

    action: int
    speed_m_s: float
    climb_m_s: float
    raised_m: float
    drift_m_s: float
    surplus_m_s: float
    other: int


AS_PLANNED = Manoeuvre(FREE, 0.0, 0.0, 0.0, 0.0, 0.0, -1)


def going_on(manoeuvre: Manoeuvre, separation_m: float) -> Manoeuvre:
    """The manoeuvre a tick later."""
    if manoeuvre.climb_m_s == 0.0:
        return manoeuvre
    most = HEIGHTS * separation_m
    raised = clamp(manoeuvre.raised_m + manoeuvre.climb_m_s * TICK_S, 0.0, most)
    climb = 0.0 if raised == 0.0 or raised == most else manoeuvre.climb_m_s
    return Manoeuvre(
        manoeuvre.action,
        manoeuvre.speed_m_s,
        climb,
        raised,
        manoeuvre.drift_m_s,
        manoeuvre.surplus_m_s,
        manoeuvre.other,
    )


def aside(errors: PathErrors, manoeuvre: Manoeuvre) -> PathErrors:
    """The deviations from the path as it is flown now: raised."""
    return PathErrors(
        errors.along,
        errors.along_rate,
        errors.across,
        errors.above - manoeuvre.raised_m,
        errors.v_t,
        errors.v_n,
        errors.v_z - manoeuvre.climb_m_s,
        errors.heading,
        errors.curvature,
        errors.slope,
        errors.reference_acceleration,
    )


def yielding_acceleration(
    errors: PathErrors, manoeuvre: Manoeuvre, airspeed_wanted: float, airspeed: float, follows: bool
) -> float:
    """u_t of one who gives way: s_ref'' - k (e' - speed), or the airspeed hold of one who follows no schedule."""
    if follows:
        return errors.reference_acceleration - RATE_GAIN * (errors.along_rate - manoeuvre.speed_m_s)
    return speed_acceleration(airspeed_wanted + manoeuvre.speed_m_s, airspeed)


def drift_of(now: Situation, manoeuvre: Manoeuvre) -> float:
    """How the lead of one who follows its schedule changes by itself, a mean of e': it may have to catch up."""
    if manoeuvre.action != FREE:
        return 0.0
    return manoeuvre.drift_m_s + SCHEDULE_SHARE * (now.errors.along_rate - manoeuvre.drift_m_s)


def surplus_of(now: Situation, manoeuvre: Manoeuvre) -> float:
    """How much faster than its schedule it is, or would be, at the commanded airspeed: what the wind makes of it."""
    _, rate, _, _ = quadratic_at(now.clock.time_s, now.point.schedule_piece, now.tables.schedule)
    _, rate_there = scheduled_at(now)
    new = now.errors.along_rate + rate * now.clock.rate - rate_there - (now.airspeed - now.airspeed_wanted)
    return manoeuvre.surplus_m_s + WIND_SHARE * (new - manoeuvre.surplus_m_s)


def pace_alone(now: Situation, manoeuvre: Manoeuvre) -> float:
    """The pace of one who hangs, in shares of what it intends: it holds its airspeed."""
    if not now.follows:
        return 1.0
    _, rate, _, _ = quadratic_at(now.clock.time_s, now.point.schedule_piece, now.tables.schedule)
    alone = (rate + manoeuvre.surplus_m_s) / max(rate * now.clock.rate, SLOWEST_M_S)
    return clamp(alone, SLOWEST, FASTEST)


def return_speed(now: Situation, airframe: Airframe) -> float:
    """How its lead changes once it follows its schedule again, m/s: towards 0, as its airspeed allows."""
    if now.errors.along > 0.0:
        return -clamp(now.airspeed_wanted - airframe.airspeed_min_m_s, LEAST_M_S, RETURN_M_S)
    return clamp(airframe.airspeed_max_m_s - now.airspeed_wanted, LEAST_M_S, RETURN_M_S)


def means(action: int, now: Situation, airframe: Airframe) -> tuple[float, float]:
    """Speed and climb rate that an action is flown with now; both 0 when there is none, or hardly any.

    Speeds within the limits of the airspeed, climb rates within what power is left beside that of the path.
    """
    slower = clamp(now.airspeed_wanted - airframe.airspeed_min_m_s - SPEED_ROOM_M_S, 0.0, MOST_SPEED_M_S)
    faster = clamp(airframe.airspeed_max_m_s - SPEED_ROOM_M_S - now.airspeed_wanted, 0.0, MOST_SPEED_M_S)
    speed, climb = 0.0, 0.0
    if action in (SLOWER, CLIMB_SLOWER):
        speed = -slower
    elif action == FASTER and climb_left(now.airspeed_wanted + faster, now, airframe) > 0.0:
        speed = faster
    if action in (CLIMB, CLIMB_SLOWER):
        climb = min(climb_left(now.airspeed_wanted + speed, now, airframe), MOST_CLIMB_M_S)
    if action == CLIMB_SLOWER and min(-speed, climb) < LEAST_M_S:
        return 0.0, 0.0
    if max(abs(speed), climb) < LEAST_M_S:
        return 0.0, 0.0
    return speed, climb


def climb_left(airspeed: float, now: Situation, airframe: Airframe) -> float:
    """What power allows at an airspeed beyond the path's own climb, m/s; negative when it does not allow that."""
    weight = airframe.mass_kg * GRAVITY_M_S2
    surplus = POWER_SHARE * thrust_max_n(airspeed, airframe) - drag_n(airspeed, weight, airframe)
    return min(surplus * airspeed / weight, airframe.climb_rate_max_m_s) - now.errors.v_t * now.errors.slope


def pace_of(now: Situation, manoeuvre: Manoeuvre, separation_m: float) -> Pace:
    """How it goes on with a manoeuvre."""
    most_ahead, most_up = LENGTHS * separation_m, HEIGHTS * separation_m
    time_s, rate, lead, drift, settles = now.clock.time_s, now.clock.rate, now.errors.along, 0.0, False
    if not now.follows:
        time_s, _ = scheduled_at(now)
        rate, lead, drift = 1.0, 0.0, manoeuvre.surplus_m_s
    elif manoeuvre.action == FREE:
        drift, settles = manoeuvre.drift_m_s if lead * manoeuvre.drift_m_s < 0.0 else 0.0, True
    return Pace(
        time_s,
        rate,
        lead,
        drift,
        settles,
        manoeuvre.speed_m_s,
        most_ahead,
        manoeuvre.raised_m,
        manoeuvre.climb_m_s,
        most_up,
    )
