"""The graph that is left when vehicles are gone, and how it is mended."""

import itertools
from collections.abc import Collection, Iterable, Mapping

from sitl.formation.graph import Edge


def repaired(graph: Iterable[Edge], gone: Collection[int]) -> tuple[Edge, ...]:
    """The graph without those who are gone, and with new edges where that would have cut it.

    The rule: one after the other, in order of sysid, each of the gone is taken out; its neighbours, in order of sysid,
    are joined, each to the next, where no other way leads from the one to the other. So a connected graph stays
    connected, whoever is lost, with no more edges than it takes; and all find the same graph who know the same of who
    is gone, in whatever order they learnt it.
    """
    near = _neighbours(graph)
    for lost in sorted(gone):
        orphans = sorted(near.pop(lost, ()))
        for orphan in orphans:
            near[orphan].discard(lost)
        for one, next_one in itertools.pairwise(orphans):
            if next_one not in _reached(one, near):
                near[one].add(next_one)
                near[next_one].add(one)
    return tuple(sorted((p, q) for p, others in near.items() for q in others if p < q))


def parts(sysids: Collection[int], graph: Iterable[Edge]) -> list[list[int]]:
    """The vehicles that are joined by edges, part by part, in order; one when the graph is connected (lambda_2 > 0)."""
    near = {sysid: set[int]() for sysid in sysids} | _neighbours(graph)
    left, found = set(sysids), list[list[int]]()
    while left:
        part = _reached(min(left), near)
        found.append(sorted(part))
        left -= part
    return found


def _neighbours(graph: Iterable[Edge]) -> dict[int, set[int]]:
    near: dict[int, set[int]] = {}
    for p, q in graph:
        near.setdefault(p, set()).add(q)
        near.setdefault(q, set()).add(p)
    return near


def _reached(start: int, near: Mapping[int, set[int]]) -> set[int]:
    found, new = {start}, [start]
    while new:
        for other in near[new.pop()] - found:
            found.add(other)
            new.append(other)
    return found
