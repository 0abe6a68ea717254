"""Foreign stations fly an endpoint: a vehicle in its own process, twenty times as fast as the world."""

import math
import queue
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from gcs.bench.foreign_stations import practice_mission
from gcs.bench.mavsdk_station import peer_module, plugin, to_raw_items
from gcs.bench.peers import LOOPBACK, PATIENCE_S, free_udp_port
from missions.mission import MissionItem
from missions.scenario import Scenario, load_scenario
from sitl.swarm import Swarm, SwarmOptions

SPEED = 20.0
NEAR_M = 800.0
"""Twice the radius of the circles that the vehicle flies at the end of each way."""


@pytest.fixture
def port() -> int:
    return free_udp_port()


@pytest.fixture
def scenario(short_scenario: Path) -> Scenario:
    """The short one with its first vehicle only."""
    scenario = load_scenario(str(short_scenario))
    return scenario.model_copy(update={"vehicles": scenario.vehicles[:1]})


@pytest.fixture
def swarm(scenario: Scenario, port: int) -> Iterator[Swarm]:
    options = SwarmOptions(seed=1, delay_s=0.2, held=False, speed=SPEED, stations=((LOOPBACK, port),))
    with Swarm(scenario, options) as swarm:
        yield swarm


def until(telemetry: Any, stream: str, wanted: Callable[[Any], bool]) -> Any:
    """Wait for a value of one of MAVSDK's telemetry streams."""
    values: queue.SimpleQueue[Any] = queue.SimpleQueue()
    subscription = getattr(telemetry, f"subscribe_{stream}")(lambda value, _: values.put(value))
    try:
        while not wanted(value := values.get(timeout=PATIENCE_S)):
            pass
        return value
    finally:
        getattr(telemetry, f"unsubscribe_{stream}")(subscription)


def near(item: MissionItem) -> Callable[[Any], bool]:
    """Whether a position of MAVSDK's is close to an item."""

    def check(position: Any) -> bool:
        north_m = (position.latitude_deg - item.lat_deg) * 111_000.0
        east_m = (position.longitude_deg - item.lon_deg) * 111_000.0 * math.cos(math.radians(item.lat_deg))
        return math.hypot(north_m, east_m) < NEAR_M

    return check


def test_mavsdk_flies_a_mission_and_brings_the_vehicle_home_while_mavproxy_looks_on(
    scenario: Scenario, swarm: Swarm, port: int, mavsdk: Any, mavproxy: Any
) -> None:
    (vehicle,) = scenario.vehicles
    mission = practice_mission(scenario, vehicle, 60)
    ready = swarm.endpoints[vehicle.sysid].ready
    assert ready is not None
    watcher = mavproxy(f"tcp:{LOOPBACK}:{ready.tcp_port}")
    watcher.wait_for(f"online system {vehicle.sysid}")
    (system,) = mavsdk(f"udpin://{LOOPBACK}:{port}").wait_for([vehicle.sysid])
    modes = peer_module("mavsdk.plugins.telemetry.telemetry").FlightMode
    missions, action, telemetry = (plugin(name, system) for name in ("mission_raw", "action", "telemetry"))

    missions.upload_mission(to_raw_items(mission.items))
    action.arm()
    missions.start_mission()
    until(telemetry, "in_air", bool)
    until(telemetry, "flight_mode", lambda mode: mode == modes.MISSION)
    until(telemetry, "position", near(mission[5]))
    assert telemetry.armed()
    assert telemetry.home().latitude_deg == pytest.approx(mission[0].lat_deg, abs=1e-6)
    assert missions.mission_progress().total == len(mission)
    watcher.wait_for("Mode AUTO")
    watcher.wait_for("waypoint 3")

    missions.set_current_mission_item(20)
    until(telemetry, "position", near(mission[20]))
    missions.pause_mission()
    until(telemetry, "flight_mode", lambda mode: mode == modes.HOLD)
    watcher.wait_for("Mode LOITER")

    target = mission[10]
    action.goto_location(target.lat_deg, target.lon_deg, target.alt_m, math.nan)
    watcher.wait_for("Mode GUIDED")
    until(telemetry, "position", near(target))

    action.return_to_launch()
    until(telemetry, "flight_mode", lambda mode: mode == modes.RETURN_TO_LAUNCH)
    watcher.wait_for("Mode RTL")
    until(telemetry, "position", near(mission[0]))


def test_what_the_vehicle_refuses_has_a_reason_that_both_stations_are_told(
    scenario: Scenario, swarm: Swarm, port: int, mavsdk: Any, mavproxy: Any
) -> None:
    (vehicle,) = scenario.vehicles
    ready = swarm.endpoints[vehicle.sysid].ready
    assert ready is not None
    watcher = mavproxy(f"tcp:{LOOPBACK}:{ready.tcp_port}")
    watcher.wait_for(f"online system {vehicle.sysid}")
    (system,) = mavsdk(f"udpin://{LOOPBACK}:{port}").wait_for([vehicle.sysid])
    texts: queue.SimpleQueue[Any] = queue.SimpleQueue()
    plugin_telemetry = plugin("telemetry", system)
    plugin_telemetry.subscribe_status_text(lambda value, _: texts.put(value.text))
    with pytest.raises(peer_module("mavsdk.plugins.action.action").ActionError):
        plugin("action", system).return_to_launch()
    while "not flying" not in texts.get(timeout=PATIENCE_S):
        pass
    watcher.wait_for("AP: .*not flying")
