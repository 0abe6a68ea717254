"""PX4s as an operator meets them: told by their heartbeats, given missions in their own form, flown like the others."""

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from pymavlink.dialects.v20 import ardupilotmega as mavlink

from gcs.flight_modes import custom_mode
from gcs.run_folder import RunFolder
from missions.autopilot import Autopilot
from missions.commands import Command, Frame
from missions.fence import Fence, FenceCircle
from missions.formats.qgc_plan import home_item, write_plan
from missions.formats.qgc_plan_reader import read_plan
from missions.mission import Mission, MissionItem
from missions.px4 import TAKEOFF_AHEAD_M
from missions.vehicle_plan import Plan
from sitl.modes import Mode

HOME = (465_000_000, 113_000_000, 1200.0)
FENCE = Fence((FenceCircle(True, HOME[:2], 9000.0),))


def place(command: Command, north_e7: int, alt_m: float, **params: float) -> MissionItem:
    lat_e7, lon_e7, _ = HOME
    return MissionItem(command, Frame.GLOBAL, lat_e7=lat_e7 + north_e7, lon_e7=lon_e7, alt_m=alt_m, **params)


TAKEOFF = place(Command.NAV_TAKEOFF, 20_000, 1250.0)
JUMPING = Mission(
    (
        home_item(*HOME),
        TAKEOFF,
        place(Command.NAV_WAYPOINT, 100_000, 1300.0, param2=80.0),
        MissionItem(Command.DO_CHANGE_SPEED, Frame.MISSION, 0.0, 22.0, -1.0),
        place(Command.NAV_WAYPOINT, 150_000, 1300.0, param2=80.0),
        MissionItem(Command.DO_JUMP, Frame.MISSION, 2.0, 3.0),
        place(Command.NAV_LOITER_UNLIM, 50_000, 1300.0, param3=-90.0),
    )
)


@pytest.fixture
def ask(skein: Callable[..., Any]) -> Callable[..., Any]:
    """Run a command of an operator, connected to the URLs given first."""
    return lambda urls, *words: skein(*words, *(word for url in urls for word in ("--connect", url)))


@pytest.fixture
def px4(make_px4: Any) -> Any:
    return make_px4(3, HOME)


def test_a_run_goes_to_each_autopilot_in_its_own_form(
    make_px4: Any, ask: Any, run_folder: Path, make_vehicle: Any, serve: Any
) -> None:
    px4, arduplane = make_px4(1), make_vehicle(2)
    urls = (px4.url, f"tcp://127.0.0.1:{serve(arduplane).tcp_port}")
    result = ask(urls, "upload", run_folder, "--vehicle", "1,2", "--json")
    assert result.exit_code == 0, result.output
    _, formation = RunFolder(run_folder).read()
    first, second, _ = (uav.mission for uav in formation.uavs)
    counts = {row["sysid"]: row["result"]["mission"] for row in json.loads(result.stdout)["vehicles"]}
    assert counts == {1: len(first) - 1, 2: len(second)}
    assert arduplane.mission.items[1:] == second.items[1:]
    takeoff, *rest = px4.plans[0]
    assert px4.begins_at == 0
    assert (takeoff.command, takeoff.alt_m) == (Command.NAV_TAKEOFF, first[1].alt_m)
    ahead_m = RunFolder(run_folder).read()[0].frame.from_e7(takeoff.lat_e7, takeoff.lon_e7)
    home_m = formation.uavs[0].waypoints_m[0]
    assert sum((a - b) ** 2 for a, b in zip(ahead_m, home_m[:2], strict=True)) ** 0.5 == pytest.approx(
        TAKEOFF_AHEAD_M, abs=0.1
    )
    assert [item.command for item in rest] == [item.command for item in first.items[2:]]
    assert [(item.lat_e7, item.lon_e7) for item in rest] == [(item.lat_e7, item.lon_e7) for item in first.items[2:]]


def test_a_file_comes_back_as_it_was_sent_jumps_and_fence_and_all(px4: Any, ask: Any, tmp_path: Path) -> None:
    sent = Plan(JUMPING, FENCE)
    write_plan(sent, tmp_path / "sent.plan", cruise_speed_m_s=22.0, autopilot=Autopilot.px4)
    result = ask([px4.url], "upload", tmp_path / "sent.plan", "--vehicle", "3")
    assert result.exit_code == 0, result.output
    assert px4.plans[0][4].param1 == 1.0  # a jump back to the first waypoint, which PX4 counts from the take-off
    result = ask([px4.url], "download", "--vehicle", "3", "--out", tmp_path / "held")
    assert result.exit_code == 0, result.output
    assert read_plan(tmp_path / "held" / "3.plan") == sent
    assert json.loads((tmp_path / "held" / "3.plan").read_text())["mission"]["firmwareType"] == 12
    assert ask([px4.url], "clear", "all", "--vehicle", "3").exit_code == 0
    assert set(px4.plans.values()) == {()}


def test_without_a_home_there_is_nothing_to_write(make_px4: Any, ask: Any, tmp_path: Path) -> None:
    result = ask([make_px4(3).url], "download", "--vehicle", "3", "--out", tmp_path, "--json")
    assert result.exit_code == 1
    assert "vehicle 3: has no home; wait until it has a position" in result.stdout


def test_a_file_without_home_is_sent_where_it_is_said_to_be_and_complex_items_are_left_out_if_asked(
    px4: Any, ask: Any, run_folder: Path, tmp_path: Path
) -> None:
    bare = tmp_path / "bare.waypoints"
    bare.write_text("QGC WPL 120\n0\t1\t0\t16\t0\t80\t0\t0\t46.51\t11.30\t1300\t1\n")
    refused = ask([px4.url], "upload", bare, "--vehicle", "3")
    assert refused.exit_code == 2
    assert "--home" in refused.output
    result = ask([px4.url], "upload", bare, "--vehicle", "3", "--home", "46.5,11.3,1200")
    assert result.exit_code == 0, result.output
    assert [item.lat_e7 for item in px4.plans[0]] == [465_100_000]
    write_plan(Plan(JUMPING), tmp_path / "survey.plan", cruise_speed_m_s=22.0)
    survey = json.loads((tmp_path / "survey.plan").read_text())
    survey["mission"]["items"].append({"type": "ComplexItem", "complexItemType": "survey", "version": 5})
    (tmp_path / "survey.plan").write_text(json.dumps(survey))
    assert ask([px4.url], "upload", tmp_path / "survey.plan", "--vehicle", "3").exit_code == 2
    skipped = ask([px4.url], "upload", tmp_path / "survey.plan", "--vehicle", "3", "--complex", "skip")
    assert skipped.exit_code == 0, skipped.output
    assert len(px4.plans[0]) == len(JUMPING) - 1
    assert ask([px4.url], "upload", run_folder, "--complex", "skip").exit_code == 2


def test_what_px4_would_refuse_is_not_sent(px4: Any, ask: Any, tmp_path: Path) -> None:
    late = Mission((JUMPING.home, JUMPING[2], TAKEOFF))
    write_plan(Plan(late), tmp_path / "late.plan", cruise_speed_m_s=22.0)
    result = ask([px4.url], "upload", tmp_path / "late.plan", "--vehicle", "3", "--json")
    assert result.exit_code == 1
    assert "vehicle 3: mission item 2: to PX4 the take-off is the first item with a place" in result.stdout
    assert px4.plans[0] == ()


def test_modes_are_its_own(px4: Any, ask: Any) -> None:
    for mode in (Mode.AUTO, Mode.RTL):
        assert ask([px4.url], "mode", mode.name, "--vehicle", "3").exit_code == 0
        assert px4.custom_mode == custom_mode(mode, Autopilot.px4)
    (row,) = json.loads(ask([px4.url], "status", "--vehicle", "3", "--json").stdout)["vehicles"]
    assert row["result"]["mode"] == "RTL"
    refused = ask([px4.url], "mode", "GUIDED", "--vehicle", "3", "--json")
    assert refused.exit_code == 1
    assert "vehicle 3: PX4 has no mode GUIDED; it has MANUAL, TAKEOFF, LOITER, AUTO, RTL" in refused.stdout


def test_one_on_the_ground_is_disarmed_not_sent_home(px4: Any, ask: Any) -> None:
    assert ask([px4.url], "arm", "--vehicle", "3").exit_code == 0
    assert px4.armed
    assert ask([px4.url], "abort", "--vehicle", "3").exit_code == 0
    assert not px4.armed
    assert mavlink.MAV_CMD_DO_SET_MODE not in px4.commands


def test_one_in_the_air_is_sent_home_and_stays_armed(px4: Any, ask: Any) -> None:
    px4.armed, px4.flown_s = True, 60.0
    assert ask([px4.url], "abort", "--vehicle", "3").exit_code == 0
    assert (px4.armed, px4.custom_mode) == (True, custom_mode(Mode.RTL, Autopilot.px4))


def test_a_swarm_of_them_is_flown_in_their_own_modes_and_at_commanded_airspeeds(
    make_px4: Any, ask: Any, run_folder: Path
) -> None:
    scenario, formation = RunFolder(run_folder).read()
    references = formation.references(scenario)
    vehicles = [make_px4(sysid, None, references[sysid], scenario.frame) for sysid in references]
    result = ask([one.url for one in vehicles], "fly", run_folder, "--json")
    assert result.exit_code == 0, result.output
    assert all(one["started_s"] < 1.0 for one in json.loads(result.stdout)["vehicles"])
    for one in vehicles:
        mode, arming = (one.commands.index(number) for number in (mavlink.MAV_CMD_DO_SET_MODE, 400))
        assert mode < arming
        assert one.custom_mode == custom_mode(Mode.AUTO, Autopilot.px4)
        assert one.airspeeds_m_s
