"""The communication graph as it was: who heard whom, from when on."""

from collections.abc import Iterable
from dataclasses import dataclass
from itertools import groupby

from sitl.formation.graph import Edge, EdgeChange
from sitl.ticks import TICK_S


@dataclass(frozen=True)
class GraphUsed:
    """From a simulated time on, the pairs of vehicles of which each made use of the other's samples."""

    t_s: float
    edges: tuple[Edge, ...]


def graph_used(changes: Iterable[EdgeChange]) -> tuple[GraphUsed, ...]:
    """The graph at each of its changes, in order."""
    heard: set[Edge] = set()
    found: list[GraphUsed] = []
    for tick, together in groupby(sorted(changes), key=lambda change: change[0]):
        for _, sender, receiver, used in together:
            (heard.add if used else heard.discard)((sender, receiver))
        edges = tuple(sorted((p, q) for p, q in heard if p < q and (q, p) in heard))
        if not found or found[-1].edges != edges:
            found.append(GraphUsed(tick * TICK_S, edges))
    return tuple(found)
