"""Failures that a scenario schedules, in simulated time: part of the flight, and the same each time."""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any, Literal

Interval = tuple[int, int]
"""Ticks [from, to)."""
FOR_EVER = 1 << 62

Kind = Literal["kill", "freeze", "silence", "split"]


@dataclass(frozen=True)
class Failure:
    """One failure.

    Attributes:
        kind: "kill": the vehicles are gone. "freeze": what computes the formation law hangs: a plain autopilot flies
            on, and nothing is said or heard. "silence": nothing that they say is heard, and they hear nothing.
            "split": vehicles of different groups do not hear each other; those in no group form one more.
        vehicles: sysids; of a silence, none means all.
        groups: of a split.
        ticks: when; a kill is for ever.
    """

    kind: Kind
    vehicles: frozenset[int]
    groups: tuple[frozenset[int], ...]
    ticks: Interval


def silences(sender: int, receiver: int, failures: Iterable[Failure]) -> list[Interval]:
    """When nothing that the sender says reaches the receiver, by the sender's ticks; in order, they may overlap."""
    return sorted(failure.ticks for failure in failures if _parts(failure, sender, receiver))


def frozen(sysid: int, failures: Iterable[Failure]) -> list[Interval]:
    """When a vehicle flies as a plain autopilot, in order; they may overlap."""
    return sorted(failure.ticks for failure in failures if failure.kind == "freeze" and sysid in failure.vehicles)


def death_tick(sysid: int, failures: Iterable[Failure]) -> int:
    """The tick at which a vehicle is gone; FOR_EVER when it is not."""
    return min(
        (failure.ticks[0] for failure in failures if failure.kind == "kill" and sysid in failure.vehicles),
        default=FOR_EVER,
    )


def within(tick: int, intervals: Any) -> bool:
    """Whether a tick lies in one of them. In the dialect that plain Python and numba compute alike."""
    for i in range(len(intervals)):  # noqa: SIM110 (numba knows no any())
        if intervals[i][0] <= tick < intervals[i][1]:
            return True
    return False


def _parts(failure: Failure, sender: int, receiver: int) -> bool:
    pair = {sender, receiver}
    if failure.kind == "split":
        return _group(sender, failure.groups) != _group(receiver, failure.groups)
    if failure.kind == "kill":
        return sender in failure.vehicles
    return bool(pair & failure.vehicles) or (failure.kind == "silence" and not failure.vehicles)


def _group(sysid: int, groups: tuple[frozenset[int], ...]) -> int:
    return next((i for i, group in enumerate(groups) if sysid in group), -1)
