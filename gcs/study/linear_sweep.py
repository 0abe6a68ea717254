"""The linear law on several graphs: growth of a disturbance over delay, and the margins that it is held against."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from gcs.study.amplification import edge_gains
from gcs.study.graphs import Graph
from gcs.study.linear import Formation, bare_law, flown_law, growth_rate, growth_rate_sampled
from missions.scenario import Scenario
from sitl.formation.graph import edges, laplacian
from sitl.formation.law import Gains
from sitl.formation.margin import aircraft_margin_s, continuous_margin_s
from sitl.ticks import TICK_S

FloatArray = npt.NDArray[np.float64]

BARE, FLOWN, TICKS = "bare", "flown", "flown, ticks"
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
            "flown, ticks": computed once a tick.
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


def scenario_gains(scenario: Scenario) -> Gains:
    """The formation's."""
    formation = scenario.formation
    return Gains(formation.k1, formation.k2, formation.k3, formation.k0)


def laplacian_of(scenario: Scenario, graph: Graph, *, unit: bool = False) -> FloatArray:
    """Weighted as flown, or with unit weights; rows in order of sysid."""
    sysids = [vehicle.sysid for vehicle in scenario.vehicles]
    matrix = laplacian(sysids, edges(graph, sysids))
    if unit:
        matrix = -(matrix < 0.0).astype(np.float64)
        matrix -= np.diag(matrix.sum(axis=1))
    return matrix


def continuous_margin(formation: Formation) -> float:
    """The least delay at which some mode swings for ever; of a formation whose vehicles are all alike."""
    gains = formation.gains._replace(k3=float(formation.damping[0]), k0=float(formation.pins[0]))
    modes = np.linalg.eigvalsh(formation.laplacian)
    return min(continuous_margin_s(mode, gains) for mode in modes if mode > 1e-9)


def growths(scenario: Scenario, name: str, graph: Graph) -> list[Growth]:
    """Both laws over delays on both sides of their margins, and the one flown in ticks as well."""
    everyone = np.ones(len(scenario.vehicles))
    gains = scenario_gains(scenario)
    bare = bare_law(laplacian_of(scenario, graph, unit=True), gains, everyone)
    flown = flown_law(laplacian_of(scenario, graph), gains, everyone)
    found = []
    for law, formation in ((BARE, bare), (FLOWN, flown)):
        margin_s = continuous_margin(formation)
        for share in SHARES:
            rate = growth_rate(formation, share * margin_s, duration_s(margin_s))
            found.append(Growth(name, law, share * margin_s, margin_s, rate))
    margin_s = aircraft_margin_s(flown.laplacian, flown.gains, 0.0, TICK_S)
    for ticks in sorted({max(1, round(share * margin_s / TICK_S)) for share in SHARES}):
        rate = growth_rate_sampled(flown, ticks, duration_s(margin_s))
        found.append(Growth(name, TICKS, ticks * TICK_S, margin_s, rate))
    return found


def duration_s(margin_s: float) -> float:
    """How long a simulation lasts."""
    return max(LEAST_DURATION_S, DURATION_DELAYS * margin_s)


def pins(scenario: Scenario) -> Mapping[str, FloatArray]:
    """h_p of all vehicles, and of the first alone, in order of sysid."""
    n = len(scenario.vehicles)
    return {PIN_ALL: np.ones(n), PIN_ONE: np.eye(n)[0]}


def pin_growths(scenario: Scenario) -> list[Growth]:
    """The law as flown on the scenario's graph, with all pinned and with one; the margin is that of all."""
    matrix, gains = laplacian_of(scenario, scenario.formation.graph), scenario_gains(scenario)
    margin_s = continuous_margin(flown_law(matrix, gains, np.ones(len(matrix))))
    return [
        Growth("", pinned, share * margin_s, margin_s, growth_rate(formation, share * margin_s, duration_s(margin_s)))
        for pinned, h in pins(scenario).items()
        for formation in [flown_law(matrix, gains, h)]
        for share in SHARES
    ]


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
    matrix, gains = laplacian_of(scenario, "line"), scenario_gains(scenario)
    margin_s = continuous_margin(flown_law(matrix, gains, np.ones(len(matrix))))
    chain = [(row, row + 1) for row in range(len(matrix) - 1)]
    found = []
    for pinned, h in pins(scenario).items():
        for share in LINE_SHARES:
            errors, speeds = edge_gains(flown_law(matrix, gains, h), share * margin_s, chain)
            found.append(Amplification(pinned, share, tuple(errors.tolist()), tuple(speeds.tolist())))
    return found
