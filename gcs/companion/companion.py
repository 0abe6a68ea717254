"""One vehicle's companion: from its telemetry and its neighbours' deviations to the airspeed it should fly."""

import math
from collections.abc import Callable, Mapping

from gcs.companion.speed_law import speed_over_ground_m_s
from gcs.companion.tracker import Fix, Tracker
from missions.airframe import Airframe
from missions.frame import LocalFrame
from missions.reference import Reference
from sitl.formation.correction import Correction
from sitl.guidance.path_law import clamp
from sitl.services.peer import Message
from sitl.ticks import TICK_S

PERIOD_S = 1.0
"""Between commands, by the vehicle's clock."""
STEP_M_S = 0.1
"""Smaller changes are not commanded."""


class Companion:
    """Keeps one vehicle with its neighbours.

    It is told of messages as they come; `command` is called when the vehicle should fly at another airspeed. It does
    nothing before the launch, and nothing once the path is over.

    Args:
        slot: system id of the vehicle in the plan, which its neighbours know it by.
        reference, frame: what the vehicle is to fly.
        airframe: whose airspeed limits are kept.
        weights: a_pq of its neighbours, by their slots.
        stale_s: what a neighbour said so long ago counts no more, by the vehicles' clocks.
        say: tells the neighbours.
        heard: gives the newest that each neighbour has said.
        command: called with an airspeed, m/s.

    Attributes:
        fix: where the vehicle is beside its plan; None before the launch.
        asked_m_s: the airspeed commanded last.
    """

    def __init__(
        self,
        slot: int,
        reference: Reference,
        frame: LocalFrame,
        airframe: Airframe,
        weights: Mapping[int, float],
        stale_s: float,
        say: Callable[[Correction], None],
        heard: Callable[[], Mapping[int, Correction]],
        command: Callable[[float], None],
    ) -> None:
        self.fix: Fix | None = None
        self.asked_m_s = math.nan
        self._slot = slot
        self._reference = reference
        self._tracker = Tracker(reference, frame)
        self._airframe = airframe
        self._weights = weights
        self._stale_s = stale_s
        self._say, self._heard, self._command = say, heard, command
        self._airspeed_m_s: float | None = None
        self._told_tick = -1
        self._due_s = 0.0

    @property
    def late_start_m(self) -> float:
        """How far along its path the vehicle was when it was first heard of in the air; 0 before."""
        return self._tracker.began_at_s_m or 0.0

    @property
    def done(self) -> bool:
        """Whether the path is over."""
        return self.fix is not None and self.fix.s_m >= self._reference.length_m

    @property
    def arrival_s(self) -> float | None:
        """When the path was over, since the launch, between two messages; None before."""
        fix = self.fix
        if fix is None or not self.done:
            return None
        return fix.time_s - (fix.s_m - self._reference.length_m) / max(fix.scheduled_m_s + fix.along_rate_m_s, 1.0)

    def on_message(self, message: Message) -> None:
        """Take in one message of the vehicle."""
        kind = message.get_type()
        if kind == "VFR_HUD":
            self._airspeed_m_s = message.airspeed
        elif kind == "GLOBAL_POSITION_INT" and self._airspeed_m_s is not None and not self.done:
            fix = self._tracker.fix(message, self._airspeed_m_s)
            if fix is not None:
                self.fix = fix
                self._keep_together(fix)

    def neighbours(self, fix: Fix) -> list[tuple[float, float]]:
        """(a_pq, e_q) of each neighbour that is heard, carried on to now."""
        found = []
        for slot, sample in self._heard().items():
            age_s = fix.time_s - sample.tick * TICK_S
            if slot in self._weights and sample.in_formation and abs(age_s) <= self._stale_s:
                found.append((self._weights[slot], sample.along_m + sample.along_rate_m_s * age_s))
        return found

    def _keep_together(self, fix: Fix) -> None:
        flying, tick = not self.done, max(round(fix.time_s / TICK_S), 0)
        if tick > self._told_tick:
            self._told_tick = tick
            self._say(Correction(self._slot, tick, tick, flying, fix.along_m, fix.along_rate_m_s))
        if fix.time_s < self._due_s or not flying:
            return
        self._due_s = fix.time_s + PERIOD_S
        wanted = speed_over_ground_m_s(fix.scheduled_m_s, fix.along_m, self.neighbours(fix))
        airspeed = clamp(
            wanted * fix.stretch - fix.tailwind_m_s, self._airframe.airspeed_min_m_s, self._airframe.airspeed_max_m_s
        )
        if not abs(airspeed - self.asked_m_s) < STEP_M_S:
            self.asked_m_s = airspeed
            self._command(airspeed)
