"""Scenarios: what is planned and flown, read from TOML and checked at the door."""

from missions.scenario.load import (
    load_scenario,
    parse_scenario,
    read_scenario_text,
    scenario_folder,
    shipped_scenarios,
)
from missions.scenario.model import Scenario
from missions.scenario.vehicles import VehicleModel

__all__ = [
    "Scenario",
    "VehicleModel",
    "load_scenario",
    "parse_scenario",
    "read_scenario_text",
    "scenario_folder",
    "shipped_scenarios",
]
