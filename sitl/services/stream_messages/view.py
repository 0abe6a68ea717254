"""What the telemetry of one instant is made from.

Here and in `flight` is the boundary at which Skein's axes (x east, y north, z up; angles anticlockwise from +x; bank
positive left) become MAVLink's (north, east, down; clockwise from north; roll positive right).
"""

import math
from dataclasses import dataclass
from functools import cached_property

from missions.frame import LocalFrame
from missions.mission import Mission, MissionItem
from sitl.snapshot import Snapshot


@dataclass(frozen=True)
class View:
    """A vehicle at one instant.

    Attributes:
        snapshot: the vehicle's state.
        frame: the local frame of its position.
        home: where it returns to.
        mission: the mission it holds, home first.
        plan_ids: opaque ids of its mission, fence and rally points; 0 = none.
        epoch_s: UNIX time at which simulated time was zero.
    """

    snapshot: Snapshot
    frame: LocalFrame
    home: MissionItem
    mission: Mission
    plan_ids: tuple[int, int, int]
    epoch_s: float

    @property
    def time_boot_ms(self) -> int:
        """Simulated time; like every autopilot's, it begins anew after 49.7 days."""
        return round(self.snapshot.time_s * 1000) % 2**32

    @cached_property
    def lat_lon_e7(self) -> tuple[int, int]:
        """Position in 1e-7 degrees."""
        x_m, y_m, _ = self.snapshot.position_m
        return self.frame.to_e7(x_m, y_m)

    @property
    def altitude_m(self) -> float:
        """Altitude AMSL."""
        return self.frame.alt_m + self.snapshot.position_m[2]

    @property
    def ground_speed_m_s(self) -> float:
        """Horizontal speed over the ground."""
        east, north, _ = self.snapshot.ground_velocity_m_s
        return math.hypot(east, north)

    @property
    def yaw(self) -> float:
        """Heading clockwise from north, radians in (-pi, pi]."""
        return math.atan2(math.cos(self.snapshot.heading), math.sin(self.snapshot.heading))
