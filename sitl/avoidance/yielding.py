"""What is told of who gives way: to the stations, and in the record of a flight."""

from collections.abc import Mapping
from typing import NamedTuple


class Yielding(NamedTuple):
    """A vehicle begins to give way at a tick, or has ended it.

    Attributes:
        tick: from which on.
        other: sysid of whom it gives way to.
        distance_m, in_s: how near they would have come, and in how many seconds; None at the end.
    """

    tick: int
    other: int
    distance_m: float | None = None
    in_s: float | None = None

    def __str__(self) -> str:
        if self.distance_m is None:
            return f"Yields no more to UAV {self.other}"
        return f"Yielding to UAV {self.other}: {self.distance_m:.0f} m predicted in {self.in_s:.0f} s"


Yieldings = Mapping[int, tuple[Yielding, ...]]
"""By sysid, in order."""
