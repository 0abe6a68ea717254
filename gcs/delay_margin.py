"""How much delay a scenario's formation bears."""

from missions.scenario import Scenario
from sitl.formation.graph import edges, laplacian
from sitl.formation.law import Gains
from sitl.formation.margin import aircraft_margin_s
from sitl.ticks import TICK_S


def delay_margin_s(scenario: Scenario) -> float:
    """The `aircraft` delay margin of a scenario's formation (MODEL, section 6); infinite when it has none."""
    formation = scenario.formation
    sysids = [vehicle.sysid for vehicle in scenario.vehicles]
    gains = Gains(formation.k1, formation.k2, formation.k3, formation.k0)
    matrix = laplacian(sysids, edges(formation.graph, sysids))
    return aircraft_margin_s(matrix, gains, scenario.airframe.thrust_lag_s, TICK_S)
