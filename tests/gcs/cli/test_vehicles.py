"""An operator's commands on three vehicles that are well."""

import json
import time
from pathlib import Path
from typing import Any

import pytest
from pymavlink import mavutil
from typer.testing import Result

from gcs.run_folder import RunFolder
from missions.formats.qgc_plan import write_plan
from missions.formats.qgc_plan_reader import read_plan
from missions.plan_type import PlanType
from missions.vehicle_plan import Plan
from sitl.services.opaque_id import opaque_id

PATIENCE_S = 20.0


def wait_until(sim: Any, shown: Any) -> dict[int, Any]:
    """The status of all vehicles, once it shows something."""
    deadline_s = time.monotonic() + PATIENCE_S
    while not shown(reports := sim.json("status", "--vehicle", "1-3")):
        assert time.monotonic() < deadline_s, reports
    return reports


def refusal(result: Result) -> str:
    """What a command says that was given something wrong: one line."""
    assert result.exit_code == 2, result.output
    assert result.stdout == ""
    (line,) = result.stderr.splitlines()
    return line


def test_status_fits_80_columns_and_names_whoever_is_there(swarm: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COLUMNS", "80")
    result = swarm("status")
    assert result.exit_code == 0
    assert all(len(line) <= 80 for line in result.stdout.splitlines())
    for sysid, url in swarm.tcp.items():
        (row,) = (line for line in result.stdout.splitlines() if line.startswith(f"│ {sysid} "))
        assert url.removeprefix("tcp://") in row
        assert "MANUAL" in row
        assert "disarmed" in row


def test_status_over_the_udp_port_tells_programs_the_same(swarm: Any, skein: Any) -> None:
    result = skein("status", "--json", "--connect", swarm.udp, "--vehicle", "1,3")
    first, third = json.loads(result.stdout)["vehicles"]
    assert (first["sysid"], third["sysid"]) == (1, 3)
    assert first["result"]["answers"] is third["result"]["answers"] is True
    assert first["result"]["address"].startswith("udp 127.0.0.1:")


def test_commands_keep_logs_where_the_operator_wants_them(
    swarm: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("SKEIN_LOGS", str(tmp_path / "logs"))
    before_s = time.time()
    assert swarm("params", "get", "RTL_ALTITUDE", "--vehicle", "1-2").exit_code == 0
    first, second, *_ = sorted((tmp_path / "logs").iterdir())
    assert (first.name[:2], second.name[:2], first.suffix) == ("1-", "2-", ".tlog")
    log = mavutil.mavlink_connection(str(first))
    kinds = {}
    while (message := log.recv_msg()) is not None:
        kinds[message.get_type()] = message._timestamp
    log.close()
    assert {"PARAM_REQUEST_READ", "PARAM_VALUE", "HEARTBEAT"} <= kinds.keys()
    assert all(before_s - 1 <= stamp <= time.time() for stamp in kinds.values())
    (tmp_path / "file").touch()
    monkeypatch.setenv("SKEIN_LOGS", str(tmp_path / "file"))
    assert refusal(swarm("arm")).startswith("skein: SKEIN_LOGS: ")


def test_missions_of_a_run_go_up_come_down_and_are_cleared(swarm: Any, run_folder: Path, tmp_path: Path) -> None:
    assert swarm("upload", run_folder, "--vehicle", "1-3").stdout.count("ok │ mission") == 3
    saved = swarm.json("download", "--out", tmp_path, "--vehicle", "1,2-3")
    planned = {uav.sysid: uav.mission for uav in RunFolder(run_folder).read()[1].uavs}
    assert {sysid: read_plan(Path(one["file"])).mission for sysid, one in saved.items()} == planned
    assert swarm.json("clear", "all", "--vehicle", "2") == {2: ["mission", "fence", "rally"]}
    refused = swarm("mode", "auto", "--vehicle", "2")
    assert refused.exit_code == 1
    assert "mode AUTO refused" in refused.stdout
    held = swarm.json("status", "--vehicle", "1-3")
    assert [sysid for sysid, one in held.items() if one["mission_items"]] == [1, 3]
    identities = {sysid: opaque_id(PlanType.MISSION, mission) for sysid, mission in planned.items()}
    assert {sysid: one["mission_id"] for sysid, one in held.items()} == {**identities, 2: 0}


def test_one_file_goes_to_the_vehicle_that_was_chosen(swarm: Any, run_folder: Path, tmp_path: Path) -> None:
    file = tmp_path / "leader.plan"
    leader = RunFolder(run_folder).read()[1].uavs[0].mission
    write_plan(Plan(leader), file, cruise_speed_m_s=25.0)
    assert "one file for several vehicles (1, 2, 3)" in refusal(swarm("upload", file, "--wait", "1.5"))
    assert swarm.json("upload", file, "--vehicle", "3") == {3: {"mission": len(leader)}}


def test_a_folder_of_exported_files_goes_to_the_vehicles_that_they_are_named_for(
    swarm: Any, skein: Any, run_folder: Path, tmp_path: Path
) -> None:
    assert skein("export", run_folder, "--format", "plan", "--frame", "relative", "--out", tmp_path).exit_code == 0
    counts = swarm.json("upload", tmp_path)
    held = swarm.json("download", "--out", tmp_path / "held", "--vehicle", "1-3")
    for file in tmp_path.glob("*.plan"):
        sysid = int(file.name.split("-")[0])
        sent = read_plan(file)
        assert read_plan(Path(held[sysid]["file"])) == sent
        assert counts[sysid]["mission"] == len(sent.mission)
        assert counts[sysid]["rally"] == 1
    (tmp_path / "2-again.plan").write_bytes(next(tmp_path.glob("2-*.plan")).read_bytes())
    assert "another file here is for vehicle 2, too" in refusal(swarm("upload", tmp_path))


def test_parameters_are_listed_read_set_saved_and_loaded(swarm: Any, tmp_path: Path) -> None:
    everything = swarm.json("params", "list", "--vehicle", "1")[1]
    assert (
        swarm.json("params", "get", "rtl_altitude", "--vehicle", "1") == {1: everything["RTL_ALTITUDE"]} == {1: 100.0}
    )
    assert swarm("params", "set", "RTL_ALTITUDE", "120.1", "--vehicle", "1,3").stdout.count("ok │ 120.1") == 2
    saved = swarm.json("params", "save", tmp_path, "--vehicle", "1-3")
    assert all(one["parameters"] == len(everything) for one in saved.values())
    loaded = swarm.json("params", "load", tmp_path / "1.param", "--vehicle", "1-3")
    assert {sysid: list(changed) for sysid, changed in loaded.items()} == {1: [], 2: ["RTL_ALTITUDE"], 3: []}
    assert swarm.json("params", "load", tmp_path, "--vehicle", "1-3") == {1: {}, 2: {"RTL_ALTITUDE": 100.0}, 3: {}}
    ids = swarm.json("params", "get", "MAV_SYSID", "--vehicle", "1-3")
    assert ids == {1: 1.0, 2: 2.0, 3: 3.0}, "a file of one vehicle makes no others of it"


def test_a_system_id_is_for_one_vehicle_only(swarm: Any) -> None:
    assert "choose one with --vehicle" in refusal(swarm("params", "set", "mav_sysid", "9", "--wait", "1.5"))


def test_a_parameter_that_is_refused_fails_in_the_vehicle_s_words(swarm: Any) -> None:
    result = swarm("params", "set", "RTL_ALTITUDE", "1e6", "--vehicle", "2", "--json")
    assert result.exit_code == 1
    (row,) = json.loads(result.stdout)["vehicles"]
    assert row["ok"] is False
    assert "RTL_ALTITUDE must be -1 to 10000" in row["error"]
    assert "has no parameter NONSENSE" in swarm("params", "get", "NONSENSE", "--vehicle", "2").stdout


def test_vehicles_are_armed_fly_are_brought_home_and_say_so(swarm: Any, run_folder: Path) -> None:
    chosen = ("--vehicle", "1-3")
    swarm.json("upload", run_folder, *chosen)
    swarm.json("arm", *chosen)
    assert swarm.json("abort", *chosen) == dict.fromkeys((1, 2, 3), "on the ground, disarmed now")
    swarm.json("arm", *chosen)
    assert swarm("mode", "auto", *chosen).stdout.count("ok │ AUTO") == 3
    wait_until(swarm, lambda reports: all(one["landed_state"] == "in air" for one in reports.values()))
    refused = swarm("disarm", "--vehicle", "1")
    assert refused.exit_code == 1
    assert "disarming refused" in refused.stdout
    assert swarm.json("abort", *chosen) == dict.fromkeys((1, 2, 3), "flying home (RTL)")
    assert {(one["mode"], one["armed"]) for one in swarm.json("status", *chosen).values()} == {("RTL", True)}
    swarm.json("disarm", "--force", *chosen)


def test_a_key_is_given_wanted_and_taken_away(swarm: Any, tmp_path: Path, skein: Any) -> None:
    key, chosen = tmp_path / "key", ("--vehicle", "2")
    assert skein("signing", "new", key).exit_code == 0
    assert "File exists" in refusal(skein("signing", "new", key))
    try:
        assert "signs with the key" in swarm("signing", "set", key, *chosen).stdout
        assert swarm.json("params", "get", "RTL_ALTITUDE", *chosen, "--signing-key", key)
        silent = swarm("status", "--wait", "0.5", "--vehicle", "1", "--signing-key", key)
        assert silent.exit_code == 1
        assert "unsigned: give it the key" in silent.output
    finally:
        assert "does not sign" in swarm("signing", "off", *chosen, "--signing-key", key).stdout
    assert swarm.json("params", "get", "RTL_ALTITUDE", *chosen)


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["status", "--vehicle", "0"], "system ids are 1 to 255"),
        (["status", "--vehicle", "3-1"], "system ids are 1 to 255"),
        (["status", "--vehicle", "1,,2"], "is no system id; write 3 or 1,4-6"),
        (["status", "--vehicle", "lead"], "'lead' is no system id"),
        (["mode", "HOVER"], "mode HOVER: there are MANUAL, AUTO"),
        (["upload", "nowhere"], "nowhere: neither a run's folder nor a .plan or .waypoints file"),
        (["upload", "nowhere.plan"], "nowhere.plan: No such file"),
        (["params", "load", "nowhere.param"], "nowhere.param: No such file"),
        (["signing", "set", "nowhere.key"], "nowhere.key: No such file"),
        (["arm", "--vehicle", "1,7", "--wait", "1.5"], "vehicle 7: no heartbeat within 1.5 s"),
    ],
)
def test_wrong_input_is_one_line_and_does_nothing(
    swarm: Any, arguments: list[str], said: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    assert said in refusal(swarm(*arguments))


@pytest.mark.parametrize(
    ("url", "said"),
    [
        ("tcp://127.0.0.1:1", "tcp 127.0.0.1:1: Connection refused; start the vehicle or check the address"),
        ("tcp://127.0.0.1", "no port of 1 to 65535 at the end"),
        ("http://127.0.0.1:80", "unknown kind of link; accepted are"),
        ("udpin://127.0.0.1:0", "no vehicle heard within 0.1 s"),
        ("serial:///dev/nowhere:57600", "nowhere"),
    ],
)
def test_a_wrong_link_is_named(url: str, said: str, skein: Any) -> None:
    assert said in refusal(skein("status", "--connect", url, "--wait", "0.1"))


def test_a_file_of_another_station_is_checked_against_a_vehicles_parameters_and_flown(swarm: Any) -> None:
    file = Path(__file__).parents[2] / "missions" / "formats" / "corpus" / "good" / "qgc_4.plan"
    result = swarm("check", file, "--vehicle", "2", "--json")
    assert result.exit_code == 1, result.output
    checked = json.loads(result.stdout)
    (problem,) = checked["problems"]
    assert not any(line.startswith("how many items") for line in checked["not_checked"])
    assert problem["what"] == "the fence would not be heeded"
    assert problem["value"].startswith("FENCE_ENABLE 0")
    held = swarm.json("upload", file, "--vehicle", "2")[2]
    assert held["mission"] == 6
    assert swarm("check", file).exit_code == 2  # of several vehicles one must be chosen
