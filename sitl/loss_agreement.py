"""Who is lost and from when on, agreed among all who are left: each tells all others whom it misses and since when."""

from collections.abc import Callable, Collection, Set

from missions.reassignment import Loss
from sitl.ticks import TICK_S

Tell = Callable[[int, frozenset[int], int], None]
"""Tells all others in a vehicle's name whom it misses, and at which tick it has noticed."""


class LossAgreement:
    """Agrees on losses that no schedule has foreseen.

    They count from the greatest of the ticks at which those who are left have missed the same vehicles: so all count
    them from one tick, unless one more is lost, or cut off, just while it tells. Half of a swarm or less agrees on
    nothing: it may be they who are cut off.

    Args:
        here: vehicles that it speaks for.
        everyone: all of the swarm.
        tell: see `Tell`.
        patience_ticks: nobody is missed before being gone for so long.
    """

    def __init__(self, here: Collection[int], everyone: Collection[int], tell: Tell, patience_ticks: int = 0) -> None:
        self._here = tuple(here)
        self._everyone = frozenset(everyone)
        self._tell = tell
        self._patience_ticks = patience_ticks
        self._missed: frozenset[int] = frozenset()
        self._since_tick = 0
        self._told = dict.fromkeys(everyone, (self._missed, 0))
        self._counted = self._missed

    def miss(self, gone: Set[int], tick: int) -> None:
        """These, and no others, are gone at a tick; at any time, and once a tick where there is patience."""
        missed = frozenset(gone)
        if missed != self._missed:
            self._missed, self._since_tick = missed, tick
        if tick - self._since_tick < self._patience_ticks:
            return
        for sysid in self._here:
            if self._told[sysid][0] != missed and sysid not in missed:
                self._told[sysid] = missed, tick
                self._tell(sysid, missed, tick)

    def hear(self, sysid: int, missed: frozenset[int], tick: int) -> None:
        """Another vehicle tells whom it misses, and since which tick."""
        self._told[sysid] = missed, tick

    def is_settled(self) -> bool:
        """Whether all who are left miss the same vehicles, or are too few to agree on anything."""
        left = self._everyone - self._missed
        return self._few(left) or all(self._told[sysid][0] == self._missed for sysid in left)

    def agreed(self) -> Loss | None:
        """The loss on which all have agreed since it was last asked for."""
        left, new = self._everyone - self._missed, self._missed - self._counted
        if not new or self._few(left) or not self.is_settled():
            return None
        self._counted |= new
        return Loss(max(self._told[sysid][1] for sysid in left) * TICK_S, new)

    def _few(self, left: Collection[int]) -> bool:
        return 2 * len(left) <= len(self._everyone)
