"""Communication graphs over vehicles in order of sysid (MODEL, section 6)."""

import itertools
from collections.abc import Iterable, Sequence

import numpy as np
import numpy.typing as npt

Edge = tuple[int, int]
EdgeChange = tuple[int, int, int, bool]
"""Tick, sender, receiver, and whether the receiver makes use of the sender's samples from then on."""


def edges(kind: str | Iterable[Edge], sysids: Sequence[int]) -> tuple[Edge, ...]:
    """The edges (p, q), p < q, of a graph over vehicles.

    Args:
        kind: ring, line, star (around the first) or complete; or pairs of sysids, of which those count that fly.
        sysids: of the vehicles.

    Raises:
        ValueError: no such graph.
    """
    nodes = sorted(sysids)
    if not isinstance(kind, str):
        return tuple(sorted({(min(pair), max(pair)) for pair in kind if set(pair) <= set(nodes)}))
    chain = list(itertools.pairwise(nodes))
    if kind == "line":
        pairs = chain
    elif kind == "ring":
        pairs = [*chain, (nodes[0], nodes[-1])] if len(nodes) > 2 else chain
    elif kind == "star":
        pairs = [(nodes[0], node) for node in nodes[1:]]
    elif kind == "complete":
        pairs = [(p, q) for i, p in enumerate(nodes) for q in nodes[i + 1 :]]
    else:
        raise ValueError(f"no graph {kind!r}; there are ring, line, star and complete")
    return tuple(sorted(pairs))


def neighbour_weights(sysid: int, graph: Sequence[Edge]) -> dict[int, float]:
    """a_pq = 1 / max(d_p, d_q) of each neighbour q of a vehicle p, in order of sysid.

    The weights are symmetric and keep the largest eigenvalue of the Laplacian at most 2 on any graph.
    """
    degree: dict[int, int] = {}
    for edge in graph:
        for node in edge:
            degree[node] = degree.get(node, 0) + 1
    near = sorted({p if q == sysid else q for p, q in graph if sysid in (p, q)})
    return {node: 1.0 / max(degree[sysid], degree[node]) for node in near}


def laplacian(sysids: Sequence[int], graph: Sequence[Edge], *, unit_weights: bool = False) -> npt.NDArray[np.float64]:
    """The weighted Laplacian D - A, (n, n), rows in order of sysid; with all weights 1 where that is asked for."""
    nodes = sorted(sysids)
    row = {node: i for i, node in enumerate(nodes)}
    matrix = np.zeros((len(nodes), len(nodes)))
    for node in nodes:
        for other, weight in neighbour_weights(node, graph).items():
            a_pq = 1.0 if unit_weights else weight
            matrix[row[node], row[other]] = -a_pq
            matrix[row[node], row[node]] += a_pq
    return matrix
