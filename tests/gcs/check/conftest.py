"""Missions about the vee's origin, without wind, for the tests of checks."""

from collections.abc import Callable

import pytest

from missions.commands import Command, Frame
from missions.mission import MissionItem
from missions.scenario import Scenario, load_scenario


@pytest.fixture(scope="session")
def calm() -> Scenario:
    vee = load_scenario("vee")
    still = {"steady_m_s": (0.0, 0.0), "forecast_m_s": (0.0, 0.0), "gusts": "none"}
    return vee.model_copy(update={"wind": vee.wind.model_copy(update=still)})


@pytest.fixture(scope="session")
def place(calm: Scenario) -> Callable[..., MissionItem]:
    """Items of a command with params, east and north of the origin (metres) and above it."""

    def make(command: int, east: float = 0.0, north: float = 0.0, z: float = 0.0, **params: float) -> MissionItem:
        positional = command not in (Command.NAV_TAKEOFF, Command.DO_JUMP, Command.DO_CHANGE_SPEED)
        lat_e7, lon_e7 = calm.frame.to_e7(east, north) if positional else (0, 0)
        return MissionItem(command, Frame.GLOBAL_RELATIVE_ALT, lat_e7=lat_e7, lon_e7=lon_e7, alt_m=z, **params)

    return make


@pytest.fixture(scope="session")
def home(calm: Scenario) -> MissionItem:
    lat_e7, lon_e7 = calm.frame.to_e7(0.0, 0.0)
    return MissionItem(Command.NAV_WAYPOINT, lat_e7=lat_e7, lon_e7=lon_e7, alt_m=calm.frame.alt_m)
