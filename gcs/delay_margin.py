"""How much delay a scenario's formation bears."""

from functools import lru_cache

from missions.scenario import Scenario
from sitl.formation.graph import edges, laplacian
from sitl.formation.law import Gains
from sitl.formation.margin import aircraft_margin_s
from sitl.ticks import TICK_S


def delay_margin_s(scenario: Scenario) -> float:
    """The `aircraft` delay margin of a scenario's formation (MODEL, section 6); infinite when it has none."""
    formation = scenario.formation
    gains = Gains(formation.k1, formation.k2, formation.k3, formation.k0)
    sysids = tuple(vehicle.sysid for vehicle in scenario.vehicles)
    return _margin_s(formation.graph, sysids, gains, scenario.airframe.thrust_lag_s)


@lru_cache
def _margin_s(graph: str, sysids: tuple[int, ...], gains: Gains, thrust_lag_s: float) -> float:
    return aircraft_margin_s(laplacian(sysids, edges(graph, sysids)), gains, thrust_lag_s, TICK_S)
