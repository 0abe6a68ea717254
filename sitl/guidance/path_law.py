"""Keeping to the path: cross-track and vertical accelerations, a plain autopilot's speed (MODEL, section 6)."""

from typing import NamedTuple

from missions.airframe import GRAVITY_M_S2, Airframe
from sitl.guidance.path_errors import PathErrors

POSITION_GAIN = 0.16
"""1/s^2, of cross-track and vertical errors."""
VELOCITY_GAIN = 0.6
"""1/s."""
SPEED_GAIN = 0.5
"""1/s, of a plain autopilot's airspeed hold."""
ACROSS_LIMIT_M = 60.0
"""Cross-track errors count at most this much, so that a far path is met at some 35 degrees. In a formation flight they
stay below 10 m."""
ABOVE_LIMIT_M = 60.0
"""The same for the vertical error; the limits of the climb rate are reached before it."""
SPEED_MARGIN_M_S = 0.5
"""The law keeps this far from the lowest airspeed."""
TAN_LATERAL_LIMIT = 0.8390996311772799
"""tan 40 deg: the lateral acceleration is limited to g times this."""
LIMIT_TIME_S = 1.0
"""A speed limit is approached no faster than within this time."""
SPEED_ROOM_M_S = 2.0
"""So near to the limits of its airspeed, what flies no mission cares more for that than for its altitude."""
PLANNED_ROOM_M_S = -2.0
"""What flies one does only so far beyond them, where no sound mission brings it."""
SPEED_ROOM_GAIN = 5.0
"""1/s, from airspeed beyond the room to climb acceleration."""
UP_LIMIT_M_S2 = 6.0
DOWN_LIMIT_M_S2 = -4.0


class Accelerations(NamedTuple):
    """Wanted accelerations in a level frame that looks along `heading`: ahead, left, up. m/s^2 and radians."""

    ahead: float
    left: float
    up: float
    heading: float


def clamp(value: float, low: float, high: float) -> float:
    """The value, kept between two bounds."""
    return low if value < low else high if value > high else value


def across_acceleration(errors: PathErrors) -> float:
    """u_n: feed-forward of the turn, and feedback of the cross-track error."""
    across = clamp(errors.across, -ACROSS_LIMIT_M, ACROSS_LIMIT_M)
    return errors.curvature * errors.v_t * errors.v_t - POSITION_GAIN * across - VELOCITY_GAIN * errors.v_n


def up_acceleration(above: float, v_z: float, v_z_wanted: float) -> float:
    """u_h: feedback of the vertical error and of the climb rate."""
    return -POSITION_GAIN * clamp(above, -ABOVE_LIMIT_M, ABOVE_LIMIT_M) - VELOCITY_GAIN * (v_z - v_z_wanted)


def speed_acceleration(airspeed_wanted: float, airspeed: float) -> float:
    """u_t of a plain autopilot: it holds an airspeed."""
    return SPEED_GAIN * (airspeed_wanted - airspeed)


def speed_before_height(wanted: Accelerations, airspeed: float, room_m_s: float, airframe: Airframe) -> Accelerations:
    """Climb or sink less than wanted where the airspeed is nearer than `room_m_s` to its limits."""
    slow = airframe.airspeed_min_m_s + room_m_s
    fast = airframe.airspeed_max_m_s - room_m_s
    if slow <= airspeed <= fast:
        return wanted
    up = wanted.up - SPEED_ROOM_GAIN * (max(slow - airspeed, 0.0) - max(airspeed - fast, 0.0))
    return Accelerations(wanted.ahead, wanted.left, up, wanted.heading)


def limited(wanted: Accelerations, airspeed: float, v_z: float, airframe: Airframe) -> Accelerations:
    """The accelerations within what keeps airspeed, turn rate and climb rate inside their limits (29)."""
    lateral = GRAVITY_M_S2 * TAN_LATERAL_LIMIT
    up = clamp(
        wanted.up,
        (airframe.climb_rate_min_m_s - v_z) / LIMIT_TIME_S,
        (airframe.climb_rate_max_m_s - v_z) / LIMIT_TIME_S,
    )
    return Accelerations(
        clamp(
            wanted.ahead,
            (airframe.airspeed_min_m_s + SPEED_MARGIN_M_S - airspeed) / LIMIT_TIME_S,
            (airframe.airspeed_max_m_s - airspeed) / LIMIT_TIME_S,
        ),
        clamp(wanted.left, -lateral, lateral),
        clamp(up, DOWN_LIMIT_M_S2, UP_LIMIT_M_S2),
        wanted.heading,
    )
