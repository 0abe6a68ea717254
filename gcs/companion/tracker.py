"""Where a vehicle is beside its plan, from its telemetry: GLOBAL_POSITION_INT and VFR_HUD."""

import math
from typing import NamedTuple

import numpy as np

from missions.frame import LocalFrame
from missions.reference import Reference
from missions.reference.smoothing import quadratic_at, quadratics_at
from sitl.guidance.path_errors import START, ScheduleClock, path_errors
from sitl.services.peer import Message

LAUNCHED_M_S = 8.0
"""Over ground: no aircraft of this kind is on the ground any more."""
PROJECTION_STEPS = 4
"""Newton steps for each position: messages may have been lost since the last."""
WIND_TIME_S = 3.0
"""The measured tailwind is smoothed over this, so that gusts are not chased."""


class Fix(NamedTuple):
    """Beside the plan at one moment.

    Attributes:
        time_s: of the schedule, since the launch.
        s_m: arc length on the path.
        along_m, along_rate_m_s: e and e'.
        scheduled_m_s: s_ref', along the path.
        stretch: what a metre along the path is over ground: less inside a turn, more outside.
        tailwind_m_s: along the path.
    """

    time_s: float
    s_m: float
    along_m: float
    along_rate_m_s: float
    scheduled_m_s: float
    stretch: float
    tailwind_m_s: float


class Tracker:
    """Follows one vehicle along its plan, from its launch on.

    The schedule begins when the vehicle is first heard of in the air, at the time that has it where it is. It is that
    of the launch, unless a companion begins in flight.

    Args:
        reference: what the vehicle flies.
        frame: that the reference is in.

    Attributes:
        began_at_s_m: arc length at which the vehicle was first heard of in the air; None before.
    """

    def __init__(self, reference: Reference, frame: LocalFrame) -> None:
        self.began_at_s_m: float | None = None
        self._reference = reference
        self._tables = reference.tables()
        self._frame = frame
        self._point = START
        self._zero_s = 0.0
        self._time_s = 0.0
        self._tailwind_m_s: float | None = None

    def fix(self, position: Message, airspeed_m_s: float) -> Fix | None:
        """Take in a GLOBAL_POSITION_INT and the newest airspeed; None before the launch, and of what comes late."""
        east, north = position.vy / 100.0, position.vx / 100.0
        now_s = position.time_boot_ms / 1000.0
        if (self.began_at_s_m is None and math.hypot(east, north) < LAUNCHED_M_S) or now_s < self._time_s:
            return None
        since_s, self._time_s = now_s - self._time_s, now_s
        x, y = self._frame.from_e7(position.lat, position.lon)
        here = (x, y, position.alt / 1000.0 - self._frame.alt_m)
        velocity = (east, north, -position.vz / 100.0)
        for _ in range(PROJECTION_STEPS):
            _, self._point = path_errors(here, velocity, self._clock(now_s), self._point, self._tables)
        if self.began_at_s_m is None:
            self.began_at_s_m = self._point.s_m
            self._zero_s = now_s - self._time_at(self._point.s_m)
        clock = self._clock(now_s)
        errors, self._point = path_errors(here, velocity, clock, self._point, self._tables)
        _, scheduled, _, _ = quadratic_at(clock.time_s, self._point.schedule_piece, self._tables.schedule)
        return Fix(
            clock.time_s,
            self._point.s_m,
            errors.along,
            errors.along_rate,
            scheduled,
            max(1.0 - errors.curvature * errors.across, 0.2),
            self._smoothed(errors.v_t - airspeed_m_s, since_s),
        )

    def _clock(self, now_s: float) -> ScheduleClock:
        return ScheduleClock(now_s - self._zero_s, 1.0, 0.0)

    def _time_at(self, s_m: float) -> float:
        times = np.linspace(0.0, self._reference.duration_s, 4096)
        return float(np.interp(s_m, quadratics_at(times, self._reference.schedule)[0], times))

    def _smoothed(self, tailwind_m_s: float, since_s: float) -> float:
        if self._tailwind_m_s is None:
            self._tailwind_m_s = tailwind_m_s
        share = -math.expm1(-since_s / WIND_TIME_S)
        self._tailwind_m_s += share * (tailwind_m_s - self._tailwind_m_s)
        return self._tailwind_m_s
