"""How far a vehicle has come in its mission: which item it flies, which it has reached."""

import math

import numpy as np

from missions.airframe import Airframe
from missions.commands import Command, Frame
from missions.frame import LocalFrame
from missions.mission import Mission
from missions.reference import ReferenceTables, build_reference
from missions.reference.smoothing import quadratics_at
from sitl.guidance.loiter_law import Loiter
from sitl.guidance.path_errors import START, PathPoint

REJOIN_STEP_M = 10.0
"""How finely a path is searched for the point nearest to a vehicle that comes back to it."""


class MissionProgress:
    """A mission in flight.

    Args:
        mission: with at least one waypoint away from home.

    Raises:
        InputError: the mission cannot be flown.
    """

    def __init__(
        self, mission: Mission, frame: LocalFrame, airframe: Airframe, forecast_wind_m_s: tuple[float, float]
    ) -> None:
        self.reference = build_reference(mission, frame, airframe, forecast_wind_m_s)
        self.tables: ReferenceTables = self.reference.tables()
        self.complete = False
        self._corner_s_m: list[float] = self.reference.path.corner_s_m.tolist()
        self._next_corner = 1
        takeoff = next((seq for seq, item in enumerate(mission) if item.command == Command.NAV_TAKEOFF), None)
        self._takeoff_seq = takeoff
        self._takeoff_z_m = -math.inf
        if takeoff is not None:
            item = mission[takeoff]
            base_m = mission.home.alt_m if item.frame == Frame.GLOBAL_RELATIVE_ALT else 0.0
            self._takeoff_z_m = item.alt_m + base_m - frame.alt_m
        self._end_seq = self.reference.corner_seq[-1]
        if self._end_seq + 1 < len(mission) and mission[self._end_seq + 1].command == Command.NAV_LOITER_UNLIM:
            self._end_seq += 1

    @property
    def current_seq(self) -> int:
        """The item that is being flown."""
        if self._takeoff_seq is not None:
            return self._takeoff_seq
        return self._end_seq if self.complete else self.reference.corner_seq[self._next_corner]

    def passed(self, s_m: float, z_m: float) -> list[int]:
        """The items reached since the last call, at an arc length and a height above the datum."""
        reached = []
        over_corner = s_m >= self._corner_s_m[self._next_corner]
        if self._takeoff_seq is not None and (z_m >= self._takeoff_z_m or over_corner):
            reached.append(self._takeoff_seq)
            self._takeoff_seq = None
        while not self.complete and s_m >= self._corner_s_m[self._next_corner]:
            reached.append(self.reference.corner_seq[self._next_corner])
            self._next_corner += 1
            self.complete = self._next_corner == len(self._corner_s_m)
        return reached

    def distance_to_next_m(self, s_m: float) -> float:
        """Along the path, to the current item; 0 at the end."""
        return 0.0 if self.complete else self._corner_s_m[self._next_corner] - s_m

    def final_loiter(self) -> Loiter:
        """The circle at the end of the mission."""
        x, y, _ = self.reference.target_m
        radius = self.reference.loiter_radius_m
        return Loiter(x, y, self.reference.loiter_z_m, abs(radius), -1.0 if radius > 0 else 1.0)

    def rejoin(self, x_m: float, y_m: float, s_left_m: float) -> tuple[PathPoint, float]:
        """Where to come back to the path after leaving it, and when the schedule would have been there.

        Args:
            s_left_m: arc length at which it was left; what has been flown is not flown again.

        Returns:
            The nearest point of the rest of the path, and its scheduled time since launch.
        """
        length = self.reference.length_m
        s = np.append(np.arange(min(max(s_left_m, 0.0), length), length, REJOIN_STEP_M), length)
        x, y, _, _ = self.reference.path.at(s)
        nearest = float(s[np.argmin(np.hypot(x - x_m, y - y_m))])
        times = np.linspace(0.0, self.reference.duration_s, 4096)
        when = float(np.interp(nearest, quadratics_at(times, self.reference.schedule)[0], times))
        return START._replace(s_m=nearest), when
