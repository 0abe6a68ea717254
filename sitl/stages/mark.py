"""A place in a mission, from which it can go on."""

from typing import NamedTuple

from missions.reference.reference import Speed


class Mark(NamedTuple):
    """The next item to fly, and what the items before it have left behind.

    Attributes:
        seq: of that item; the mission's length at its end.
        speed: that legs are flown at.
        jumps: (item, times followed) of each DO_JUMP that has been.
    """

    seq: int
    speed: Speed
    jumps: tuple[tuple[int, int], ...] = ()

    def times_jumped(self, seq: int) -> int:
        """How often the DO_JUMP at `seq` has been followed."""
        return dict(self.jumps).get(seq, 0)

    def jumping(self, seq: int, target: int) -> "Mark":
        """After following the DO_JUMP at `seq`."""
        jumps = dict(self.jumps) | {seq: self.times_jumped(seq) + 1}
        return self._replace(seq=target, jumps=tuple(sorted(jumps.items())))
