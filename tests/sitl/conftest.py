"""Vehicles and missions for the tests of a simulated vehicle."""

from collections.abc import Callable, Mapping
from pathlib import Path

import numpy as np
import pytest

from missions.commands import Command, Frame
from missions.mission import Mission, MissionItem
from missions.plan_type import PlanType
from missions.scenario import Scenario, load_scenario
from sitl.config import VehicleConfig
from sitl.events import ItemReached
from sitl.formation.correction import Correction
from sitl.modes import Mode
from sitl.store import Store
from sitl.swarm import SwarmOptions, vehicle_configs
from sitl.ticks import TICK_S
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


@pytest.fixture
def place(vee: Scenario) -> Callable[..., MissionItem]:
    """Items of a command with params, east and north of the lead's home (metres) and above it."""

    def make(command: int, east: float = 0.0, north: float = 0.0, z: float = 0.0, **params: float) -> MissionItem:
        positional = command not in (Command.NAV_TAKEOFF, Command.DO_JUMP, Command.DO_CHANGE_SPEED)
        lat_e7, lon_e7 = vee.frame.to_e7(east, north) if positional else (0, 0)
        return MissionItem(command, Frame.GLOBAL_RELATIVE_ALT, lat_e7=lat_e7, lon_e7=lon_e7, alt_m=z, **params)

    return make


class Flown:
    """A vehicle and its truth; `texts` and `reached` are what it has told since its start."""

    def __init__(self, config: VehicleConfig, file: Path, store: Store | None = None) -> None:
        self._file = file
        self.truth = TruthWriter(file)
        self.vehicle = Vehicle(config, self.truth, store)
        self.texts: list[str] = []
        self.reached: list[int] = []
        self.hear()

    def hear(self) -> None:
        """Take in what it has to tell."""
        for event in self.vehicle.drain_events():
            if isinstance(event, ItemReached):
                self.reached.append(event.seq)
            else:
                self.texts.append(event.text)

    def in_auto(self, *items: MissionItem) -> "Flown":
        """With a mission of these items after home, armed, in AUTO."""
        self.vehicle.load(PlanType.MISSION, (self.vehicle.home, *items))
        assert self.vehicle.arm() is None
        assert self.vehicle.set_mode(Mode.AUTO) is None
        return self

    def taken_off(self, altitude_m: float = 100.0, seconds: float = 60.0) -> "Flown":
        """Circling after a take-off."""
        assert self.vehicle.arm() is None
        assert self.vehicle.take_off(altitude_m) is None
        self.fly_s(seconds)
        assert self.vehicle.airborne
        return self

    def fly_s(self, seconds: float) -> np.ndarray:
        """Fly for some time; (n, 6) states, one a tick."""
        states = []
        for _ in range(round(seconds / TICK_S)):
            self.vehicle.observe()
            states.append(self.vehicle._pilot.flight.air)
            self.vehicle.advance({})
        self.hear()
        return np.array(states)

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

    def make(changed: VehicleConfig | None = None, store: Store | None = None) -> Flown:
        nonlocal made
        made += 1
        return Flown(changed or config, tmp_path / f"{made}.f64", store)

    return make
