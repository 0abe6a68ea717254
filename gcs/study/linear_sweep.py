"""The linear law on several graphs: growth of a disturbance over delay, and the margins that it is held against."""

from dataclasses import dataclass

from gcs.study.amplification import edge_gains
from gcs.study.graphs import Graph
from gcs.study.linear import growth_rate, growth_rate_sampled
from missions.scenario import Scenario
from sitl.formation.linear_formation import LinearFormation, linear_formation
from sitl.formation.margin import Level, margin_s, mode_margins
from sitl.ticks import TICK_S

BARE, FLOWN, TICKS = "bare", "flown", "flown in ticks"
PIN_ALL, PIN_ONE = "all", "one"
SHARES = (0.5, 0.6, 0.7, 0.8, 0.85, 0.9, 0.95, 0.98, 1.02, 1.05, 1.1, 1.15, 1.2, 1.3, 1.4, 1.5)
"""Of the margin."""
DURATION_DELAYS = 400
"""A simulation lasts so many margins, and"""
LEAST_DURATION_S = 200.0
"""at least this long, for what dies out slowly."""


@dataclass(frozen=True)
class Growth:
    """One simulation.

    Attributes:
        graph, law: "bare": the law (15) with unit weights and no k0; "flown": weights and gains of the scenario;
            "flown in ticks": computed once a tick.
        delay_s: of the corrections.
        margin_s: of this graph and law.
        rate_1_s: at which a disturbance grows.
    """

    graph: str
    law: str
    delay_s: float
    margin_s: float
    rate_1_s: float

    @property
    def share(self) -> float:
        """Delay over margin."""
        return self.delay_s / self.margin_s


def growths(scenario: Scenario, name: str, graph: Graph) -> list[Growth]:
    """Both laws over delays on both sides of their margins, and the one flown in ticks as well."""
    bare, flown = (_formation(scenario, graph, bare=bare) for bare in (True, False))
    found = []
    for law, formation in ((BARE, bare), (FLOWN, flown)):
        margin = _margin_s(scenario, formation, "continuous")
        for share in SHARES:
            rate = growth_rate(formation, share * margin, duration_s(margin))
            found.append(Growth(name, law, share * margin, margin, rate))
    margin = _margin_s(scenario, flown, "sampled")
    for ticks in sorted({max(1, round(share * margin / TICK_S)) for share in SHARES}):
        rate = growth_rate_sampled(flown, ticks, duration_s(margin))
        found.append(Growth(name, TICKS, ticks * TICK_S, margin, rate))
    return found


def duration_s(margin_s: float) -> float:
    """How long a simulation lasts."""
    return max(LEAST_DURATION_S, DURATION_DELAYS * margin_s)


def with_pins(scenario: Scenario, who: str) -> Scenario:
    """The scenario with all vehicles pinned, or the first in order of sysid alone."""
    first = min(vehicle.sysid for vehicle in scenario.vehicles)
    changes = {"pinned": None if who == PIN_ALL else (first,)}
    return scenario.model_copy(update={"formation": scenario.formation.model_copy(update=changes)})


def pin_growths(scenario: Scenario) -> list[Growth]:
    """The law as flown on the scenario's graph, with all pinned and with one; the margin is that of all."""
    found = []
    graph = scenario.formation.graph
    margin = _margin_s(scenario, _formation(with_pins(scenario, PIN_ALL), graph), "continuous")
    for who in (PIN_ALL, PIN_ONE):
        formation = _formation(with_pins(scenario, who), graph)
        for share in SHARES:
            rate = growth_rate(formation, share * margin, duration_s(margin))
            found.append(Growth("", who, share * margin, margin, rate))
    return found


@dataclass(frozen=True)
class Amplification:
    """How a disturbance of the first vehicle arrives at each edge of a line.

    Attributes:
        pinned: "all" or "one".
        share: delay over the line's margin with all pinned.
        errors_s2, speeds_s: (n - 1,) largest error and relative speed of each edge, m and m/s per m/s^2, from the
            first on.
    """

    pinned: str
    share: float
    errors_s2: tuple[float, ...]
    speeds_s: tuple[float, ...]


LINE_SHARES = (0.2, 0.5, 0.9, 0.95)


def amplifications(scenario: Scenario) -> list[Amplification]:
    """Along a line of the scenario's vehicles, with the law as flown."""
    sysids = [vehicle.sysid for vehicle in scenario.vehicles]
    chain = [(row, row + 1) for row in range(len(sysids) - 1)]
    margin = _margin_s(scenario, _formation(with_pins(scenario, PIN_ALL), "line"), "continuous")
    found = []
    for who in (PIN_ALL, PIN_ONE):
        formation = _formation(with_pins(scenario, who), "line")
        for share in LINE_SHARES:
            errors, speeds = edge_gains(formation, share * margin, chain)
            found.append(Amplification(who, share, tuple(errors.tolist()), tuple(speeds.tolist())))
    return found


def _formation(scenario: Scenario, graph: Graph, *, bare: bool = False) -> LinearFormation:
    """The scenario's vehicles on a graph, with the law as flown or the bare one with unit weights and no pin k0."""
    changes: dict[str, object] = {"graph": graph, **({"k0": 0.0} if bare else {})}
    sysids = [vehicle.sysid for vehicle in scenario.vehicles]
    return linear_formation(scenario.formation.model_copy(update=changes), sysids, bare=bare)


def _margin_s(scenario: Scenario, formation: LinearFormation, level: Level) -> float:
    return margin_s(mode_margins(formation, scenario.airframe.airframe()), level)
