"""Nine endpoints report to one UDP port, as to a ground station's 14550: foreign stations keep them apart."""

from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from gcs.bench.mavsdk_station import from_raw_items, plugin, to_raw_items
from gcs.bench.peers import LOOPBACK, free_udp_port
from missions.formats.waypoints import write_waypoints
from missions.formats.waypoints_reader import read_waypoints
from missions.mission import Mission
from sitl.modes import Mode

SYSIDS = range(1, 10)


@pytest.fixture
def port() -> int:
    return free_udp_port()


@pytest.fixture
def fleet(port: int, make_vehicle: Any, serve: Any) -> dict[int, Any]:
    """Nine vehicles by system id."""
    vehicles = {sysid: make_vehicle(sysid) for sysid in SYSIDS}
    for vehicle in vehicles.values():
        serve(vehicle, (LOOPBACK, port))
    return vehicles


@pytest.fixture
def own_mission(make_mission: Any) -> Callable[[int], Mission]:
    """A mission that no other vehicle has."""

    def make(sysid: int) -> Mission:
        home, *items = make_mission(12 + sysid)
        return Mission((home, *(replace(item, alt_m=item.alt_m + 100.0 * sysid) for item in items)))

    return make


def test_mavsdk_gives_each_its_own_mission_all_at_once(
    port: int, fleet: dict[int, Any], own_mission: Callable[[int], Mission], mavsdk: Any
) -> None:
    systems = mavsdk(f"udpin://{LOOPBACK}:{port}").wait_for(SYSIDS)

    def transfer(sysid: int, system: Any) -> Any:
        raw = plugin("mission_raw", system)
        raw.upload_mission(to_raw_items(own_mission(sysid).items))
        plugin("param", system).set_param_float("WP_RADIUS", 50.0 + sysid)
        plugin("action", system).arm()
        return from_raw_items(raw.download_mission())

    with ThreadPoolExecutor(len(SYSIDS)) as threads:
        held = dict(zip(SYSIDS, threads.map(transfer, SYSIDS, systems), strict=True))
    for sysid, vehicle in fleet.items():
        assert held[sysid] == vehicle.mission.items == own_mission(sysid).items
        assert vehicle.parameters["WP_RADIUS"] == 50.0 + sysid
        assert vehicle.state.armed


def test_mavproxy_gives_each_its_own_mission_in_turn(
    port: int, fleet: dict[int, Any], own_mission: Callable[[int], Mission], mavproxy: Any, tmp_path: Path
) -> None:
    proxy = mavproxy(f"udpin:{LOOPBACK}:{port}")
    for sysid in SYSIDS:
        proxy.wait_for(f"Detected vehicle {sysid}:1 ")
        write_waypoints(own_mission(sysid), tmp_path / f"{sysid}.sent")
    for sysid in SYSIDS:
        proxy.ask(f"vehicle {sysid}", f"Set vehicle {sysid} ")
        proxy.ask(f"wp load {sysid}.sent", "Got MISSION_ACK: TYPE_MISSION: ACCEPTED")
        proxy.ask(f"wp save {sysid}.held", f"Saved {12 + sysid} waypoints")
    proxy.ask("vehicle 4", "Set vehicle 4 ")
    proxy.ask("arm throttle", "COMPONENT_ARM_DISARM: ACCEPTED")
    proxy.ask("mode AUTO", "DO_SET_MODE: ACCEPTED")
    for sysid, vehicle in fleet.items():
        own_m, in_vehicle_m = ([item.alt_m for item in mission] for mission in (own_mission(sysid), vehicle.mission))
        assert in_vehicle_m == pytest.approx(own_m)
        assert [item.alt_m for item in read_waypoints(tmp_path / f"{sysid}.held")] == in_vehicle_m
        assert vehicle.state.armed == (sysid == 4)
        assert vehicle.state.mode == (Mode.AUTO if sysid == 4 else Mode.MANUAL)
