"""Stages straight ahead: the climb after a launch, and the glide after the engine has stopped."""

import math

from missions.airframe import GRAVITY_M_S2, Airframe, drag_n
from sitl.flight import Flight, ground_velocity
from sitl.guidance.loiter_law import COURSE_GAIN
from sitl.guidance.path_law import VELOCITY_GAIN, Accelerations, clamp, speed_acceleration, up_acceleration
from sitl.stages.mark import Mark

GLIDE_GAIN = 0.3
"""m/s of climb rate for each m/s of airspeed too many."""
GLIDE_AIRSPEED_RATIO = 1.3
"""Over the least airspeed."""
THERE_M = 3.0


class ClimbOutStage:
    """Straight ahead up to an altitude.

    Args:
        course: to keep, anticlockwise from east.
        z_m: altitude above the datum.
        seq, mark, after: of the mission's NAV_TAKEOFF, as in `CircleStage`.
    """

    def __init__(
        self, course: float, z_m: float, *, seq: int = 0, mark: Mark | None = None, after: Mark | None = None
    ) -> None:
        self.course = course
        self.z_m = z_m
        self.seq = seq
        self.done = False
        self._mark = mark
        self._after = after

    @property
    def mark(self) -> Mark | None:
        """Where the mission goes on if this is left now."""
        return self._after if self.done else self._mark

    def accelerations(self, flight: Flight, airspeed_wanted_m_s: float) -> Accelerations:
        """What it wants at this tick."""
        east, north, up = ground_velocity(flight)
        return Accelerations(
            speed_acceleration(airspeed_wanted_m_s, flight.air.V),
            _towards(self.course, east, north),
            up_acceleration(flight.air.h - self.z_m, up, 0.0),
            math.atan2(north, east),
        )

    def note(self, flight: Flight) -> None:
        """Take in how far it has come."""
        self.done = flight.air.h >= self.z_m - THERE_M


class GlideStage:
    """Straight down to the ground, without thrust, at the airspeed that takes it farthest.

    Args:
        course: to keep.
        airframe: what glides.
    """

    seq = 0
    mark: Mark | None = None

    def __init__(self, course: float, airframe: Airframe) -> None:
        self._course = course
        self.airspeed_m_s = GLIDE_AIRSPEED_RATIO * airframe.airspeed_min_m_s
        weight_n = airframe.mass_kg * GRAVITY_M_S2
        self._sink_m_s = self.airspeed_m_s * drag_n(self.airspeed_m_s, weight_n, airframe) / weight_n

    def accelerations(self, flight: Flight) -> Accelerations:
        """What it wants at this tick: the airspeed is kept by the climb rate."""
        east, north, up = ground_velocity(flight)
        climb = clamp(GLIDE_GAIN * (flight.air.V - self.airspeed_m_s), -2.0, 2.0) - self._sink_m_s
        heading = math.atan2(north, east)
        return Accelerations(0.0, _towards(self._course, east, north), -VELOCITY_GAIN * (up - climb), heading)


def _towards(course: float, east_m_s: float, north_m_s: float) -> float:
    turn = math.remainder(course - math.atan2(north_m_s, east_m_s), 2.0 * math.pi)
    return COURSE_GAIN * turn * math.hypot(east_m_s, north_m_s)
