"""The communication graph as it was: who heard whom, from when on."""

from collections.abc import Iterable
from dataclasses import dataclass
from itertools import groupby

from sitl.formation.graph import Edge, EdgeChange
from sitl.ticks import TICK_S


@dataclass(frozen=True)
class GraphUsed:
    """From a simulated time on, the pairs of vehicles of which each made use of the other's samples.

    Of who was killed without warning nobody knows what it heard: then the other's use is enough.
    """

    t_s: float
    edges: tuple[Edge, ...]


def graph_used(changes: Iterable[EdgeChange]) -> tuple[GraphUsed, ...]:
    """The graph at each of its changes, in order."""
    known = sorted(changes)
    told = {receiver for _, _, receiver, _ in known}
    heard: set[Edge] = set()
    found: list[GraphUsed] = []
    for tick, together in groupby(known, key=lambda change: change[0]):
        for _, sender, receiver, used in together:
            (heard.add if used else heard.discard)((sender, receiver))
        both = {(min(p, q), max(p, q)) for p, q in heard if (q, p) in heard or p not in told}
        edges = tuple(sorted(both))
        if not found or found[-1].edges != edges:
            found.append(GraphUsed(tick * TICK_S, edges))
    return tuple(found)
