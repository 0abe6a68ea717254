"""How much delay a scenario's formation bears."""

from functools import lru_cache

from missions.airframe import Airframe
from missions.scenario import Scenario
from missions.scenario.network import FormationModel
from sitl.formation.linear_formation import linear_formation
from sitl.formation.margin import aircraft_margin_s


def delay_margin_s(scenario: Scenario) -> float:
    """The `aircraft` delay margin of a scenario's formation (MODEL, section 6); infinite when it has none."""
    sysids = tuple(vehicle.sysid for vehicle in scenario.vehicles)
    return _margin_s(scenario.formation, sysids, scenario.airframe.airframe())


@lru_cache
def _margin_s(formation: FormationModel, sysids: tuple[int, ...], airframe: Airframe) -> float:
    return aircraft_margin_s(linear_formation(formation, sysids), airframe)
