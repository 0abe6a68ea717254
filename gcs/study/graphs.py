"""The graphs that a study of delay looks at."""

from collections.abc import Sequence

from missions.errors import InputError
from missions.scenario import Scenario
from sitl.formation.graph import Edge
from sitl.formation.topology import parts

Graph = str | tuple[Edge, ...]
NAMED = ("ring", "star", "complete", "line")


def studied_graphs(scenario: Scenario, custom: Sequence[Edge] | None = None) -> dict[str, Graph]:
    """The graphs that have names, and one of edges: the one given, else the scenario's, else the two arms of a V.

    Raises:
        InputError: the one given has a vehicle that is not there, or does not connect all.
    """
    sysids = sorted(vehicle.sysid for vehicle in scenario.vehicles)
    own = scenario.formation.graph
    if custom is not None:
        edges = tuple(custom)
        if unknown := {sysid for edge in edges for sysid in edge} - set(sysids):
            raise InputError(f"--edges: there is no vehicle {min(unknown)} in {scenario.name}")
        if len(parts(sysids, edges)) > 1:
            raise InputError("--edges: these do not connect all vehicles; add some")
    elif not isinstance(own, str):
        edges = own
    else:
        edges = tuple((sysids[max(0, i - 2)], sysid) for i, sysid in enumerate(sysids) if i > 0)
    return {**{name: name for name in NAMED}, "custom": edges}


def parse_edges(text: str) -> tuple[Edge, ...]:
    """Edges such as 1-2,2-3.

    Raises:
        InputError: it is something else.
    """
    edges = []
    for word in text.split(","):
        ends = word.strip().split("-")
        if len(ends) != 2 or not all(end.isdecimal() for end in ends) or int(ends[0]) == int(ends[1]):
            raise InputError(f"--edges {text}: must be pairs of system ids such as 1-2,2-3, got {word.strip()!r}")
        edges.append((int(ends[0]), int(ends[1])))
    return tuple(edges)
