"""A stage along a path: through waypoints, on schedule, to their end or to a touchdown."""

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from missions.reference import Reference, ReferenceTables
from missions.reference.smoothing import quadratics_at
from sitl.flight import airspeed_at
from sitl.guidance.loiter_law import Loiter
from sitl.stages.mark import Mark


class TakeoffItem(NamedTuple):
    """A NAV_TAKEOFF that the path begins with: reached at an altitude, or at the first corner."""

    seq: int
    z_m: float


class PathStage:
    """A path in flight.

    Args:
        reference: what is flown.
        marks: of each of its corners but the first, where the mission goes on when it is left before that corner.
        after: where the mission goes on at its end.
        takeoff: the take-off it begins with.
        loiter_seq: the item to circle at its end; None when the mission goes on there.
        lands: its last corner is a touchdown.

    Attributes:
        done: its last corner has been passed.
        on_final: it is on the leg to its touchdown.
        started_tick: when its schedule began.
    """

    def __init__(
        self,
        reference: Reference,
        marks: Sequence[Mark],
        after: Mark,
        *,
        takeoff: TakeoffItem | None = None,
        loiter_seq: int | None = None,
        lands: bool = False,
    ) -> None:
        self.reference = reference
        self.tables: ReferenceTables = reference.tables()
        self.loiter_seq = loiter_seq
        self.lands = lands
        self.done = False
        self.started_tick = 0
        self._marks = marks
        self._after = after
        self._takeoff = takeoff
        self._corner_s_m: list[float] = reference.path.corner_s_m.tolist()
        self._next_corner = 1
        self.on_final = lands and len(self._corner_s_m) == 2
        self._next_s_m = math.inf if self.on_final else self._corner_s_m[1]

    @property
    def seq(self) -> int:
        """The item that is being flown."""
        return self._takeoff.seq if self._takeoff else self.reference.corner_seq[self._corner]

    @property
    def mark(self) -> Mark:
        """Where the mission goes on if this is left now."""
        return self._after if self.done else self._marks[self._next_corner - 1]

    @property
    def taking_off(self) -> bool:
        """The take-off is not over."""
        return self._takeoff is not None

    @property
    def _corner(self) -> int:
        return min(self._next_corner, len(self._corner_s_m) - 1)

    @property
    def end_s_m(self) -> float:
        """Arc length of its last corner."""
        return self._corner_s_m[-1]

    def airspeed_m_s(self, s_m: float) -> float:
        """The commanded airspeed at an arc length."""
        return airspeed_at(s_m, self.tables.airspeeds)

    def distance_m(self, s_m: float) -> float:
        """Along the path, to the current item; 0 at the end."""
        return 0.0 if self.done else self._corner_s_m[self._next_corner] - s_m

    def passed(self, s_m: float, z_m: float) -> list[int]:
        """The items reached since the last call, at an arc length and a height above the datum."""
        if self._takeoff is None and s_m < self._next_s_m:
            return []
        reached = []
        seqs = self.reference.corner_seq
        if self._takeoff is not None and (z_m >= self._takeoff.z_m or s_m >= self._next_s_m):
            reached.append(self._takeoff.seq)
            self._takeoff = None
        while s_m >= self._next_s_m:
            here = self._next_corner
            if here + 1 == len(seqs) or seqs[here + 1] != seqs[here]:  # else the item is only begun
                reached.append(seqs[here])
            self._next_corner += 1
            self.done = self._next_corner == len(self._corner_s_m)
            self.on_final = self.lands and self._next_corner == len(self._corner_s_m) - 1
            self._next_s_m = math.inf if self.done or self.on_final else self._corner_s_m[self._next_corner]
        return reached

    def onto(self, reference: Reference, other: "PathStage", s_m: float) -> "PathStage":
        """The stage along a reference that begins as this one's and ends as another stage's, at an arc length."""
        marks = dict(zip(other.reference.corner_seq[1:], other._marks, strict=True))
        changed = PathStage(
            reference,
            [marks.get(seq, other._marks[0]) for seq in reference.corner_seq[1:]],
            other._after,
            loiter_seq=other.loiter_seq,
            lands=other.lands,
        )
        changed.passed(s_m, math.inf)
        changed._takeoff = self._takeoff
        changed.started_tick = self.started_tick
        return changed

    def final_loiter(self) -> Loiter:
        """The circle at its end."""
        x, y, _ = self.reference.target_m
        radius = self.reference.loiter_radius_m
        return Loiter(x, y, self.reference.loiter_z_m, abs(radius), -1.0 if radius > 0 else 1.0)

    def time_at_s(self, s_m: float) -> float:
        """When the schedule is at an arc length, since it began."""
        times = np.linspace(0.0, self.reference.duration_s, 4096)
        return float(np.interp(s_m, quadratics_at(times, self.reference.schedule)[0], times))
