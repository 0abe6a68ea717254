"""A stage round a point: fly there, circle, until something has come about."""

import math
from dataclasses import dataclass

from sitl.flight import Flight, ground_velocity
from sitl.guidance.loiter_law import Approach, Loiter, from_centre_m, loiter_accelerations, on_approach, to_go_m
from sitl.guidance.path_law import Accelerations
from sitl.stages.mark import Mark
from sitl.terrain_guard import TerrainGuard
from sitl.ticks import TICK_S

ON_CIRCLE = 0.3
"""It has arrived within this share of the radius."""
AT_ALTITUDE_M = 5.0
LEAST_STAY_S = 1.0
"""A circle is flown for so long at least: a mission that jumps back to one that asks for no time is no haste."""


@dataclass(frozen=True)
class Until:
    """When a circle has been flown: after a time on it, after turns, or once its altitude is reached; or never."""

    time_s: float = math.inf
    turns: float = math.inf
    altitude: bool = False


class CircleStage:
    """A circle in flight. It climbs at once, and glides down on the way there.

    Args:
        loiter: the circle.
        until: when it is done.
        seq: the mission item; 0 when it is none of a mission's.
        airspeed_m_s: to fly at; None for the cruise airspeed that is set.
        mark, after: where the mission goes on when it is left, and when it is done.
        guard: keeps it above the ground; None where the mission's altitudes are what counts.
        complete: the mission ends here.

    Attributes:
        done: it has been flown.
        arrived: it is on the circle.
    """

    def __init__(
        self,
        loiter: Loiter,
        until: Until | None = None,
        *,
        seq: int = 0,
        airspeed_m_s: float | None = None,
        mark: Mark | None = None,
        after: Mark | None = None,
        guard: TerrainGuard | None = None,
        complete: bool = False,
    ) -> None:
        self.loiter = loiter
        self.seq = seq
        self.airspeed_m_s = airspeed_m_s
        self.guard = guard
        self.complete = complete
        self.done = False
        self.arrived = False
        self.until = until or Until()
        self._mark = mark
        self._after = after
        self._approach: Approach | None = None
        self._ticks = 0
        self._turned = 0.0
        self._bearing = 0.0

    @property
    def mark(self) -> Mark | None:
        """Where the mission goes on if this is left now."""
        return self._after if self.done else self._mark

    def distance_m(self, flight: Flight) -> float:
        """To the centre."""
        return from_centre_m(flight.air.x, flight.air.y, self.loiter)

    def accelerations(self, flight: Flight, airspeed_wanted_m_s: float, tick: int) -> Accelerations:
        """What it wants at this tick."""
        air, velocity = flight.air, ground_velocity(flight)
        if self._approach is None:
            self._approach = Approach(air.h, to_go_m(air.x, air.y, self.loiter))
        loiter = on_approach(air.x, air.y, self.loiter, self._approach)
        if self.guard is not None:
            loiter = self.guard.above_ground(loiter, flight, velocity, tick)
        return loiter_accelerations((air.x, air.y, air.h), velocity, air.V, airspeed_wanted_m_s, loiter)

    def note(self, flight: Flight) -> None:
        """Take in how far it has come."""
        bearing = math.atan2(flight.air.y - self.loiter.y_m, flight.air.x - self.loiter.x_m)
        if self.arrived:
            self._ticks += 1
            self._turned += self.loiter.turn * math.remainder(bearing - self._bearing, 2.0 * math.pi)
        elif abs(self.distance_m(flight) - self.loiter.radius_m) <= ON_CIRCLE * self.loiter.radius_m:
            self.arrived = True
        self._bearing = bearing
        until, on_circle_s = self.until, self._ticks * TICK_S
        self.done = on_circle_s >= LEAST_STAY_S and (
            on_circle_s >= until.time_s
            or self._turned >= 2.0 * math.pi * until.turns
            or (until.altitude and abs(flight.air.h - self.loiter.z_m) <= AT_ALTITUDE_M)
        )
