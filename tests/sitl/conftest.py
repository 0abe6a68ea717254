"""Vehicles and missions for the tests of a simulated vehicle."""

from collections.abc import Callable, Mapping
from pathlib import Path

import numpy as np
import pytest

from missions.commands import Command, Frame
from missions.mission import Mission, MissionItem
from missions.scenario import Scenario, load_scenario
from sitl.config import VehicleConfig
from sitl.formation.correction import Correction
from sitl.swarm import SwarmOptions, vehicle_configs
from sitl.truth import TruthWriter
from sitl.vehicle import Vehicle


@pytest.fixture(scope="session")
def vee() -> Scenario:
    return load_scenario("vee")


@pytest.fixture
def config(vee: Scenario) -> VehicleConfig:
    """The lead of the shipped V, in light gusts."""
    return vehicle_configs(vee, SwarmOptions(seed=1, delay_s=0.2))[0]


@pytest.fixture
def straight_mission(vee: Scenario) -> Mission:
    """East from the lead's home: take-off, a climb of 1.5 km to 90 m, level to 3 km, a loiter at 130 m."""

    def item(command: int, east: float, z: float, *params: float) -> MissionItem:
        lat_e7, lon_e7 = vee.frame.to_e7(east, 0.0)
        p1, p2, p3, p4 = (*params, 0.0, 0.0, 0.0, 0.0)[:4]
        return MissionItem(command, Frame.GLOBAL, p1, p2, p3, p4, lat_e7, lon_e7, z + vee.frame.alt_m)

    return Mission(
        (
            item(Command.NAV_WAYPOINT, 0, 0),
            item(Command.NAV_TAKEOFF, 0, 30, 10.0),
            MissionItem(Command.DO_CHANGE_SPEED, Frame.MISSION, 0, 28, -1),
            item(Command.NAV_WAYPOINT, 1500, 90, 0, 50),
            item(Command.NAV_WAYPOINT, 3000, 90, 0, 50),
            item(Command.NAV_LOITER_UNLIM, 3000, 130, 0, 0, 250),
        )
    )


class Flown:
    """A vehicle and its truth."""

    def __init__(self, config: VehicleConfig, file: Path) -> None:
        self._file = file
        self.truth = TruthWriter(file)
        self.vehicle = Vehicle(config, self.truth)

    def fly(self, ticks: int, heard: Callable[[int], Mapping[int, Correction]] = lambda tick: {}) -> None:
        """Some ticks, with what the neighbours say at each."""
        for _ in range(ticks):
            own = self.vehicle.observe()
            self.vehicle.advance(heard(own.tick))

    def rows(self) -> np.ndarray:
        """Its truth, (n, 6); ends the recording."""
        self.truth.close()
        return np.fromfile(self._file).reshape(-1, 6)


@pytest.fixture
def make_flown(config: VehicleConfig, tmp_path: Path) -> Callable[..., Flown]:
    """Vehicles as configured, each with its own truth file."""
    made = 0

    def make(changed: VehicleConfig | None = None) -> Flown:
        nonlocal made
        made += 1
        return Flown(changed or config, tmp_path / f"{made}.f64")

    return make
