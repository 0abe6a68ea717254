"""A vehicle that looks out for others: for one that flies home through the formation, for one that hangs."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from missions.commands import Command, Frame
from missions.mission import MissionItem
from missions.plan_type import PlanType
from missions.scenario import Scenario
from sitl.avoidance.intent import GROUNDED, KEEPS, PERIOD_TICKS, QUIET, YIELDS
from sitl.events import StatusText
from sitl.formation.channel import Channel
from sitl.formation.failures import Failure
from sitl.formation.network import Network
from sitl.modes import Mode
from sitl.swarm import SwarmOptions, vehicle_configs
from sitl.truth import TruthWriter
from sitl.vehicle import Vehicle

SAFE_M = 75.0
LEVEL_M, BEHIND_M, NORTH_M = 100.0, 1500.0, 20.0
FROZEN = (500, 1200)
HOME_AT = 250
"""Tick at which the first vehicle is told to fly home."""


class Train:
    """Two vehicles that fly east, the second behind the first, where that would come home."""

    def __init__(
        self, vee: Scenario, folder: Path, avoid_m: float | None, end_m: float, failures: tuple[Failure, ...] = ()
    ) -> None:
        network = Network((1, 2), (), Channel(5), failures=failures)
        configs = vehicle_configs(vee, SwarmOptions(seed=3, delay_s=0.2))[:2]
        self.writers = [TruthWriter(folder / f"{avoid_m}-{config.sysid}.f64") for config in configs]
        self.vehicles: dict[int, Vehicle] = {}
        self.texts: list[str] = []
        self.distances: list[float] = []
        for config, start, writer in zip(configs, ((0.0, 0.0), (-BEHIND_M, NORTH_M)), self.writers, strict=True):
            placed = replace(config, home_m=(*start, LEVEL_M), network=network, avoid_m=avoid_m)
            vehicle = self.vehicles[config.sysid] = Vehicle(placed, writer)

            def item(command: int, x: float, y: float, radius_m: float) -> MissionItem:
                lat_e7, lon_e7 = vee.frame.to_e7(x, y)
                return MissionItem(command, Frame.GLOBAL, 0, 0, radius_m, 0, lat_e7, lon_e7, LEVEL_M + vee.frame.alt_m)

            speed = MissionItem(Command.DO_CHANGE_SPEED, Frame.MISSION, 1, 27.0, -1)
            last = item(Command.NAV_LOITER_UNLIM, start[0] + end_m, start[1], 150.0)
            vehicle.load(PlanType.MISSION, (vehicle.home, speed, last))
            vehicle.parameters.set("RTL_ALTITUDE", -1.0)
            assert vehicle.arm() is None
            assert vehicle.set_mode(Mode.AUTO) is None

    def fly(self, ticks: int) -> dict[int, list[int]]:
        """Some ticks; the statuses that each has told."""
        statuses: dict[int, list[int]] = {1: [], 2: []}
        for _ in range(ticks):
            for vehicle in self.vehicles.values():
                vehicle.observe()
            if self.avoids and self.vehicles[1].tick % PERIOD_TICKS == 0:
                intents = {i: vehicle.intent() for i, vehicle in self.vehicles.items()}
                for i, vehicle in self.vehicles.items():
                    statuses[i].append(intents[i].status)
                    vehicle.learn({other: [(told, 0)] for other, told in intents.items() if other != i}, set())
            for vehicle in self.vehicles.values():
                vehicle.advance({})
                self.texts += [event.text for event in vehicle.drain_events() if isinstance(event, StatusText)]
            places = [vehicle._pilot.flight.air[:3] for vehicle in self.vehicles.values()]
            self.distances.append(float(np.linalg.norm(np.subtract(*places))))
        return statuses

    @property
    def avoids(self) -> bool:
        return self.vehicles[1]._pilot.avoider is not None


@pytest.mark.parametrize(("avoid_m", "safe"), [(None, False), (SAFE_M, True)])
def test_one_that_flies_home_through_the_formation_is_given_way_to(
    vee: Scenario, tmp_path: Path, avoid_m: float | None, safe: bool
) -> None:
    train = Train(vee, tmp_path, avoid_m, 6000.0)
    train.fly(HOME_AT)
    assert train.vehicles[1].set_mode(Mode.RTL) is None
    statuses = train.fly(1700)
    assert (min(train.distances) >= SAFE_M) == safe, min(train.distances)
    told = [text for text in train.texts if "ield" in text]
    if safe:
        assert told[0].startswith("Yielding to UAV 1: ")
        assert told[-1] == "Yields no more to UAV 1"
        assert len(told) == 2
        assert set(statuses[1]) == {KEEPS}
        assert abs(train.vehicles[2].snapshot().altitude_error_m) < 5.0, "back on its path"
    else:
        assert told == []


def test_one_that_hangs_tells_nothing_and_one_at_the_end_of_its_mission_is_no_matter(
    vee: Scenario, tmp_path: Path
) -> None:
    train = Train(vee, tmp_path, SAFE_M, 2000.0, (Failure("freeze", frozenset({2}), (), FROZEN),))
    statuses = train.fly(2000)
    told = np.array(statuses[2])
    ticks = np.arange(len(told)) * PERIOD_TICKS
    hangs = (ticks >= FROZEN[0]) & (ticks < FROZEN[1])
    assert set(told[hangs]) == {QUIET}
    assert set(told[~hangs]) == {YIELDS, GROUNDED}
    assert told[-1] == GROUNDED
