"""One is lost, the others close up: real processes as rehearsed, and by agreement when nobody had foreseen it."""

import json
import os
import re
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from pymavlink import mavutil

from gcs.campaign.axes import with_values
from gcs.rehearsal import RehearsalOptions, rehearse_plan
from gcs.report import report_on
from gcs.run_folder import RunFolder
from missions.scenario import parse_scenario, read_scenario_text
from planner.plan import plan
from sitl.ticks import TICK_S

SKEIN = [sys.executable, "-m", "gcs.main"]
SAFE_M = 75.0
KILL = """
[[failures]]
what = "kill"
at_s = 60.0
vehicles = [3]

"""


@pytest.fixture(scope="module")
def run(tmp_path_factory: pytest.TempPathFactory) -> RunFolder:
    """The first five of the shipped V on its first two legs, the right one ahead of the last two to be killed."""
    text, _ = read_scenario_text("vee")
    head, *vehicles = re.split(r"(?=\[\[vehicles\]\])", text)
    rest = "# Aerosonde" + vehicles[-1].partition("# Aerosonde")[2]
    points = "points = [[0.0, 0.0, 0.0], [1500.0, 0.0, 100.0], [5400.0, 1000.0, 100.0]]"
    head = re.sub(r"points = \[.*?\n\]", points, head, flags=re.S).replace('name = "vee"', 'name = "closing"')
    rest = rest.replace("[formation]\n", "[formation]\nreassign = true\n")
    changed = head + "".join(vehicles[:5]) + KILL + rest
    folder = tmp_path_factory.mktemp("closing")
    scenario = parse_scenario(changed, "closing.toml", folder)
    run = RunFolder(folder)
    run.write_plan(changed, scenario, plan(scenario))
    return run


def rehearsed(run: RunFolder, **changes: Any) -> dict[str, Any]:
    scenario, planned = run.read()
    changed = with_values(scenario, changes)
    truths, record = rehearse_plan(changed, planned, RehearsalOptions(planned.seed, 0.2))
    return report_on(changed, planned, truths, record).metrics


def moves(metrics: dict[str, Any]) -> list[tuple[int, str]]:
    return [(event["sysid"], event["what"]) for event in metrics["events"] if "takes the place" in event["what"]]


def places(metrics: dict[str, Any]) -> list[int]:
    return [vehicle["place"] for vehicle in metrics["vehicles"]]


def test_a_gap_is_closed_as_rehearsed_and_errors_are_those_of_the_new_places(run: RunFolder) -> None:
    expected = rehearsed(run)
    assert moves(expected) == [(5, "takes the place of vehicle 3")]
    assert places(expected) == [1, 2, 3, 4, 3]
    assert expected["formation"]["rms_error_m"] < 2.0
    assert expected["formation"]["min_separation_m"] >= SAFE_M
    open_gap = rehearsed(run, **{"formation.reassign": False})
    assert moves(open_gap) == []
    assert open_gap["trajectory_sha256"] != expected["trajectory_sha256"]
    flown = skein_fly(run, "--json").communicate(timeout=200)[0]
    assert json.loads(flown)["trajectory_sha256"] == expected["trajectory_sha256"]
    assert json.loads(flown)["events"] == expected["events"]
    assert "Takes the place of UAV 3" in texts(run)
    left, taken = (np.fromfile(run.truth / f"{sysid}.f64").reshape(-1, 6) for sysid in (3, 5))
    assert len(left) * TICK_S == 60.0
    assert len(taken) > len(left)


def test_who_is_killed_by_a_signal_is_replaced_from_when_all_have_agreed(run: RunFolder, tmp_path: Path) -> None:
    scenario, planned = run.read()
    calm = RunFolder(tmp_path)
    text = run.scenario.read_text().replace(KILL, "")
    calm.write_plan(text, scenario.model_copy(update={"failures": ()}), planned)
    process = skein_fly(calm, "--speed", "20", "--json")
    vehicles = endpoints(calm.path)
    wait_until(lambda: all((calm.truth / f"{i}.f64").stat().st_size > 20_000 for i in vehicles))
    os.kill(vehicles[3], signal.SIGKILL)
    out, err = process.communicate(timeout=120)
    assert process.returncode == 1, err
    metrics = json.loads(out)
    assert moves(metrics) == [(5, "takes the place of vehicle 3")]
    assert places(metrics) == [1, 2, 3, 4, 3]
    assert metrics["formation"]["min_separation_m"] >= SAFE_M
    assert metrics["formation"]["rms_error_m"] < 3.0
    assert [vehicle["completed"] for vehicle in metrics["vehicles"]] == [True, True, False, True, True]
    (begun_s,) = [event["t_s"] for event in metrics["events"] if event["what"].startswith("takes")]
    (lost_s,) = [event["t_s"] for event in metrics["events"] if event["what"].startswith("lost")]
    assert begun_s > lost_s + 10.0


def skein_fly(run: RunFolder, *options: str) -> "subprocess.Popen[str]":
    command = [*SKEIN, "fly", str(run.path), *options]
    return subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)


def endpoints(path: Path) -> dict[int, int]:
    """Processes by sysid, once endpoints.json names them."""

    def read() -> dict[int, int] | None:
        try:
            vehicles = json.loads((path / "endpoints.json").read_text())["vehicles"]
        except (FileNotFoundError, ValueError):
            return None
        return {vehicle["sysid"]: vehicle["pid"] for vehicle in vehicles}

    found: dict[int, int] = wait_until(read)
    return found


def wait_until(condition: Callable[[], Any], timeout_s: float = 60.0) -> Any:
    deadline = time.monotonic() + timeout_s
    while not (found := condition()):
        assert time.monotonic() < deadline, "it did not happen in time"
        time.sleep(0.02)
    return found


def texts(run: RunFolder) -> str:
    """All that vehicle 5 has told its station, without the bounds of the wire's pieces."""
    log = mavutil.mavlink_connection(str(run.logs / "5.tlog"))
    pieces = []
    while (message := log.recv_match(type="STATUSTEXT")) is not None:
        pieces.append(message.text)
    return "".join(pieces)
