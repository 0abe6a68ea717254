"""Vehicles that know no formation law, kept together by companions: in one station, and beside each vehicle."""

import json
import re
import subprocess
import sys
from collections.abc import Callable
from contextlib import ExitStack
from pathlib import Path
from typing import Any

import pytest

SPREAD_S = 2.0
SKEIN = (sys.executable, "-m", "gcs.main")


def test_one_station_flies_all_and_all_arrive_together(start_sim: Callable[..., Any], run_folder: Path) -> None:
    with start_sim("--speed", 20, "--no-corrections", "--wipe") as sim:
        result = subprocess.run(
            [*SKEIN, "fly", str(run_folder), "--connect", sim.udp, "--json"],
            capture_output=True,
            text=True,
            timeout=120,
        )
    assert result.returncode == 0, result.stderr
    report = json.loads(result.stdout)
    assert report["arrival_spread_s"] < SPREAD_S
    assert [one["sysid"] for one in report["vehicles"]] == [1, 2, 3]
    assert all(one["started_s"] < 1.0 for one in report["vehicles"])
    # How far: a busy machine steers less often than once a simulated second.
    assert all(0.0 < one["along_rms_m"] < one["along_max_m"] for one in report["vehicles"])


def test_companions_beside_their_vehicles_agree_over_zenoh(
    start_sim: Callable[..., Any], run_folder: Path, free_port: Callable[[], int], tmp_path: Path
) -> None:
    field = tmp_path / "field.toml"
    field.write_text(f'swarm = "field"\nrouter = "tcp/127.0.0.1:{free_port()}"\n')
    with ExitStack() as stack, start_sim("--speed", 20, "--no-corrections", "--wipe") as sim:

        def launch(*arguments: object) -> "subprocess.Popen[str]":
            process = subprocess.Popen([*SKEIN, *map(str, arguments)], stdout=subprocess.PIPE, text=True)
            stack.callback(process.communicate)
            stack.callback(process.terminate)
            return process

        def wait_for(text: str, process: "subprocess.Popen[str]") -> None:
            assert process.stdout is not None
            assert any(text in line for line in process.stdout), f"{process.args} ended early"

        wait_for("Router of field", launch("router", field))
        companions = [
            launch("companion", run_folder, "--vehicle", sim.tcp[slot], "--slot", slot, "--zenoh", field)
            for slot in (1, 2, 3)
        ]
        for slot, companion in enumerate(companions, 1):
            wait_for(f"Slot {slot}: vehicle {slot} at", companion)
        for order in (("upload", run_folder), ("mode", "AUTO"), ("arm",)):
            result = sim(*order)
            assert result.exit_code == 0, result.output
        late = []
        for companion in companions:
            said, _ = companion.communicate(timeout=120)
            assert companion.returncode == 0
            (found,) = re.findall(r"arrived, ([+-][0-9.]+) s against the plan", said)
            late.append(float(found))
    assert max(late) - min(late) < SPREAD_S
    assert max(map(abs, late)) < SPREAD_S


def test_nobody_is_armed_while_one_is_not_ready(
    start_sim: Callable[..., Any], run_folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("gcs.companion.connected_flight.READY_S", 2.0)
    with start_sim("--speed", 20, "--no-corrections", "--wipe") as sim:
        assert sim("params", "set", "AIRSPEED_MIN", "35", "--vehicle", "2").exit_code == 0
        result = sim("fly", run_folder)
        assert result.exit_code == 2
        assert "not ready to arm after 2 s: vehicle 2" in result.output
        assert {row["armed"] for row in sim.json("status").values()} == {False}


def test_what_makes_no_sense_is_refused(skein: Callable[..., Any], run_folder: Path, tmp_path: Path) -> None:
    field = tmp_path / "field.toml"
    field.write_text('swarm = "field"\nrouter = "tcp/127.0.0.1:7447"\n')
    refused = skein("companion", run_folder, "--slot", "7", "--zenoh", field)
    assert refused.exit_code == 2
    assert "--slot 7: the plan has 1, 2, 3" in refused.output
    refused = skein("fly", run_folder, "--connect", "udpin://127.0.0.1:0", "--delay", "0.4")
    assert refused.exit_code == 2
    assert "leave other options out" in refused.output
