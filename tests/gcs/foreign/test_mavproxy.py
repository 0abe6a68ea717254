"""MAVProxy as a foreign station of an endpoint's face, over UDP: what its operator types, and what comes of it."""

from pathlib import Path
from typing import Any

import pytest

from missions.fence import Fence, FenceCircle, FencePolygon, fence_items, rally_items
from missions.formats.waypoints import write_waypoints
from missions.formats.waypoints_reader import read_waypoints
from missions.mission import Mission, MissionItem
from missions.plan_type import PlanType
from sitl.modes import Mode

STEP_E7 = 10
"""It writes six decimals of a degree."""

AREA = FencePolygon(True, ((464_000_000, 112_000_000), (464_000_000, 114_000_000), (466_000_000, 113_000_000)))
HOLE = FenceCircle(False, (465_000_000, 113_000_000), 300.0)


@pytest.fixture
def vehicle(make_vehicle: Any, make_mission: Any) -> Any:
    vehicle = make_vehicle(6)
    vehicle.mission = make_mission(25)
    return vehicle


@pytest.fixture
def proxy(vehicle: Any, serve: Any, mavproxy: Any) -> Any:
    """MAVProxy, which has heard the vehicle."""
    proxy = mavproxy(f"udpout:127.0.0.1:{serve(vehicle).udp_port}")
    proxy.wait_for("online system 6")
    return proxy


def close(sent: tuple[MissionItem, ...], held: tuple[MissionItem, ...]) -> bool:
    """Whether items agree, to the decimals of MAVProxy's files."""
    return len(sent) == len(held) and all(
        (a.command, a.frame) == (b.command, b.frame)
        and a.params == pytest.approx(b.params, abs=1e-5)
        and (a.lat_e7, a.lon_e7) == pytest.approx((b.lat_e7, b.lon_e7), abs=STEP_E7)
        and a.alt_m == pytest.approx(b.alt_m, abs=1e-3)
        for a, b in zip(sent, held, strict=True)
    )


def test_it_loads_lists_saves_and_clears_a_mission(proxy: Any, vehicle: Any, make_mission: Any, tmp_path: Path) -> None:
    mission = make_mission(100)
    write_waypoints(mission, tmp_path / "sent.waypoints")
    proxy.ask("wp load sent.waypoints", "Got MISSION_ACK: TYPE_MISSION: ACCEPTED")
    assert close(mission.items, vehicle.mission.items)
    proxy.ask("wp list", f"Requesting 100 waypoints(?s:.*)16 0 {mission[99].lat_deg:.7f}")
    proxy.ask("wp save held.waypoints", "Saved 100 waypoints")
    assert close(vehicle.mission.items, read_waypoints(tmp_path / "held.waypoints").items)
    proxy.ask("wp clear", "Got MISSION_ACK: TYPE_MISSION: ACCEPTED")
    assert vehicle.mission == make_mission(1)


def test_its_fence_and_rally_points_arrive_and_come_back(proxy: Any, vehicle: Any, tmp_path: Path) -> None:
    rally = rally_items([(465_000_000, 113_000_000, 100.0), (465_010_000, 113_000_000, 110.0)])
    plans = {
        "fence": (PlanType.FENCE, fence_items(Fence((AREA, HOLE)))),
        "rally": (PlanType.RALLY, rally),
    }
    for name, (plan, items) in plans.items():
        write_waypoints(Mission(items), tmp_path / f"{name}.sent")
        proxy.ask(f"{name} load {name}.sent", f"Got MISSION_ACK: TYPE_{plan.name}: ACCEPTED")
        assert close(items, vehicle.items(plan))
        proxy.ask(f"{name} save {name}.held", f"Saved {len(items)} ")
        assert close(items, read_waypoints(tmp_path / f"{name}.held").items)
        proxy.ask(f"{name} clear", f"Got MISSION_ACK: TYPE_{plan.name}: ACCEPTED")
        assert vehicle.items(plan) == ()


def test_it_sets_and_fetches_parameters(proxy: Any, vehicle: Any) -> None:
    proxy.wait_for(f"Received {len(vehicle.parameters.names)} parameters")
    proxy.ask("param set WP_RADIUS 75", "")
    proxy.repeat("param fetch WP_RADIUS", r"WP_RADIUS = 75\.0")
    assert vehicle.parameters["WP_RADIUS"] == 75.0


def test_its_modes_arming_and_current_item_are_the_vehicles(proxy: Any, vehicle: Any) -> None:
    proxy.ask("arm throttle", "COMPONENT_ARM_DISARM: ACCEPTED(?s:.*)ARMED")
    assert vehicle.state.armed
    for mode in (Mode.AUTO, Mode.LOITER, Mode.RTL, Mode.GUIDED):
        proxy.ask(f"mode {mode.name}", f"Mode {mode.name}")
        assert vehicle.state.mode == mode
    proxy.ask("wp set 7", "DO_SET_MISSION_CURRENT: ACCEPTED")
    assert ("set_current", 7) in vehicle.asked
    proxy.ask("disarm", "DISARMED")
    assert not vehicle.state.armed


def test_nothing_it_says_on_connecting_would_alarm_its_operator(proxy: Any, vehicle: Any) -> None:
    proxy.wait_for(f"Received {len(vehicle.parameters.names)} parameters")
    said = proxy.said.lower()
    for alarm in ("breach", "fail", "error", "bad ", "unknown", "timed out", "timeout", "no gps", "traceback"):
        assert alarm not in said, proxy.said
