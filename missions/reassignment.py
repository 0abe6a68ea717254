"""What it takes to close the gap that a lost vehicle leaves: who is gone, and who flies whose place from when on.

The planner finds it (`planner.reassign`), vehicles fly it (`sitl.places`), reports measure flights against it.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Protocol

from missions.mission import Mission
from missions.reference import Reference


@dataclass(frozen=True)
class Loss:
    """From a time on, in seconds of simulated time, these vehicles count as gone, beside those of earlier losses."""

    t_s: float
    gone: frozenset[int]


@dataclass(frozen=True)
class Move:
    """One vehicle takes over another's place.

    Attributes:
        sysid: of the vehicle.
        place: sysid of the vehicle whose plan it flies then.
        from_s: from when on the reference holds; it is what was flown before until the change begins,
        start_s, end_s: which it does, and ends, at these times.
        reference: what it flies.
        mission: what whose place it is was told.
    """

    sysid: int
    place: int
    from_s: float
    start_s: float
    end_s: float
    reference: Reference
    mission: Mission


@dataclass(frozen=True)
class Gap:
    """A place that nobody flies any more though one further back is flown, since when, and why."""

    t_s: float
    place: int
    why: str


@dataclass(frozen=True)
class Reassigned:
    """What losses lead to; moves in order of their losses, and of sysid."""

    moves: tuple[Move, ...] = ()
    gaps: tuple[Gap, ...] = ()

    def of(self, sysid: int) -> tuple[Move, ...]:
        """The moves of one vehicle, in order."""
        return tuple(move for move in self.moves if move.sysid == sysid)

    def place_of(self, sysid: int) -> int:
        """Whose plan a vehicle flies in the end."""
        return next((move.place for move in reversed(self.moves) if move.sysid == sysid), sysid)

    def references(self, planned: Mapping[int, Reference]) -> dict[int, Reference]:
        """What each vehicle flies from beginning to end: its last move's reference, or the planned one."""
        return dict(planned) | {move.sysid: move.reference for move in self.moves}


class Reassign(Protocol):
    """A pure function of losses: all who know the same of them find the same."""

    def __call__(self, losses: Sequence[Loss]) -> Reassigned:
        """What losses, in order of time, lead to. What the first of them lead to does not depend on the later ones."""
