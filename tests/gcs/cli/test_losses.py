"""An operator's commands when a vehicle is silent or dies, when two have one id, and when the operator gives up."""

import json
import os
import signal
import subprocess
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from gcs.transfers import transfer
from gcs.vehicle_link import VehicleLink


@pytest.fixture(scope="module")
def mortal(start_sim: Callable[..., Any]) -> Iterator[Any]:
    """Two vehicles, of another instance."""
    with start_sim("--count", 2, "--instance", 1, "--wipe") as sim:
        yield sim


@pytest.fixture
def at_the_count(monkeypatch: pytest.MonkeyPatch) -> Callable[[int, Callable[[], None]], None]:
    """Lets something happen when an upload to a vehicle has begun, its MISSION_COUNT being sent."""

    def let(sysid: int, happen: Callable[[], None]) -> None:
        send, waiting = VehicleLink.send, [happen]

        def send_and_let(vehicle: VehicleLink, message: Any) -> None:
            send(vehicle, message)
            if vehicle.sysid == sysid and message.get_type() == "MISSION_COUNT" and waiting:
                waiting.pop()()

        monkeypatch.setattr(VehicleLink, "send", send_and_let)

    return let


def test_a_vehicle_that_stands_still_holds_up_no_other(swarm: Any) -> None:
    """Unlike `arm`, which waits for all that were named: `test_wrong_input_is_one_line_and_does_nothing`."""
    named = ("--vehicle", "1-3", "--wait", "1.5")
    os.kill(swarm.pids[2], signal.SIGSTOP)
    try:
        shown, result = swarm("status", *named), swarm("abort", *named, "--json")
    finally:
        os.kill(swarm.pids[2], signal.SIGCONT)
    assert shown.exit_code == result.exit_code == 1
    assert shown.stdout.count("MANUAL") == 2
    assert "vehicle 2: no heartbeat within 1.5 s" in shown.stdout
    rows = {row["sysid"]: row for row in json.loads(result.stdout)["vehicles"]}
    assert {sysid: row["ok"] for sysid, row in rows.items()} == {1: True, 2: False, 3: True}
    assert rows[2]["error"].startswith("vehicle 2: no heartbeat within 1.5 s")


def test_ctrl_c_in_an_upload_leaves_the_old_mission(
    swarm: Any, run_folder: Path, at_the_count: Any, tmp_path: Path
) -> None:
    swarm.json("clear", "mission", "--vehicle", "2")
    at_the_count(2, lambda: signal.raise_signal(signal.SIGINT))
    result = swarm("upload", run_folder, "--vehicle", "2")
    assert result.exit_code == 130, result.output
    assert "interrupted" in result.stderr
    assert swarm.json("download", "--out", tmp_path, "--vehicle", "2")[2]["mission"] == 1


def test_two_vehicles_with_one_id_are_shown_told_apart_and_mended(mortal: Any, skein: Any) -> None:
    skein("params", "set", "MAV_SYSID", "1", "--connect", mortal.tcp[2], "--vehicle", "2")
    everyone = ("--connect", mortal.udp, "--wait", "1.5")
    refused = skein("arm", *everyone)
    assert refused.exit_code == 2
    assert "system id 1 is used by" in refused.stderr
    shown = skein("status", *everyone)
    assert shown.exit_code == 1
    assert "system id 1 is used by" in shown.stdout
    skein("params", "set", "MAV_SYSID", "2", "--connect", mortal.tcp[2], "--vehicle", "1")
    assert skein("status", *everyone, "--vehicle", "1,2").exit_code == 0


def test_instances_remember_apart_and_a_second_swarm_of_one_is_refused(
    swarm: Any, mortal: Any, short_scenario: Path, state_home: Path, sim_command: Any
) -> None:
    folders = [state_home / "skein" / "sim" / f"short-{instance}" for instance in (0, 1)]
    assert str(folders[0]) in swarm.printed
    assert str(folders[1]) in mortal.printed
    result = subprocess.run(
        sim_command(short_scenario),
        capture_output=True,
        text=True,
        timeout=60,
        env=os.environ | {"XDG_STATE_HOME": str(state_home)},
    )
    assert result.returncode == 2
    assert f"{folders[0]}: in use by another simulation (process {swarm.process.pid})" in result.stderr
    assert "--instance 1" in result.stderr


def test_a_vehicle_that_is_killed_in_an_upload_fails_alone(
    mortal: Any, run_folder: Path, at_the_count: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The last one here: nobody brings that vehicle back."""
    monkeypatch.setattr(transfer, "SILENT_S", 1.0)
    at_the_count(2, lambda: os.kill(mortal.pids[2], signal.SIGKILL))
    result = mortal("upload", run_folder, "--vehicle", "1,2", "--json")
    assert result.exit_code == 1, result.output
    assert "connection lost" in result.stderr
    first, second = json.loads(result.stdout)["vehicles"]
    assert first["ok"] is True
    assert second["error"].startswith("vehicle 2: ")
    assert "check the link" in second["error"]
