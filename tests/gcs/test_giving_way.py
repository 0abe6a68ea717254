"""Two vehicles whose ways cross, in wind that nobody has foreseen: real processes give way as they do rehearsed."""

import json
import re
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from pymavlink import mavutil

from gcs.campaign.axes import with_values
from gcs.rehearsal import RehearsalOptions, rehearse_plan
from gcs.report import report_on
from gcs.run_folder import RunFolder
from missions.scenario import parse_scenario, read_scenario_text
from planner.plan import plan
from sitl.config import Arm

SAFE_M = 100.0
ARM: Arm = "plain"
VEHICLE = """[[vehicles]]
name = "{name}"
sysid = {sysid}
origin = {origin}
target = {target}

"""


@pytest.fixture(scope="module")
def run(tmp_path_factory: pytest.TempPathFactory) -> RunFolder:
    """Planned apart; plain autopilots are blown to 82 m."""
    text, _ = read_scenario_text("crossing")
    head, *_, last = re.split(r"(?=\[\[vehicles\]\])", text)
    rest = "[airframe]" + last.partition("[airframe]")[2]
    east = VEHICLE.format(name="east", sysid=1, origin=[2000.0, 5500.0, 0.0], target=[5400.0, 5500.0, 140.0])
    north = VEHICLE.format(name="north", sysid=2, origin=[2900.0, 4100.0, 0.0], target=[2900.0, 7500.0, 140.0])
    for key, value in (("steady_m_s", [7.0, -4.0]), ("separation_m", SAFE_M), ("waypoints", 3)):
        rest = re.sub(rf"^{key} = .*$", f"{key} = {value}", rest, flags=re.M)
    rest = rest.replace("[formation]\n", "[formation]\navoidance = true\n")
    changed = head.replace('name = "crossing"', 'name = "meeting"') + east + north + rest
    folder = tmp_path_factory.mktemp("meeting")
    scenario = parse_scenario(changed, "meeting.toml", folder)
    run = RunFolder(folder)
    run.write_plan(changed, scenario, plan(scenario))
    return run


def skein(*arguments: object) -> str:
    command = [sys.executable, "-m", "gcs.main", *map(str, arguments)]
    result = subprocess.run(command, capture_output=True, text=True, timeout=200)
    assert result.returncode == 0, result.stderr
    return result.stdout


def rehearsed(run: RunFolder, *, avoidance: bool) -> dict[str, Any]:
    scenario, planned = run.read()
    changed = with_values(scenario, {"formation.avoidance": avoidance})
    truths, record = rehearse_plan(changed, planned, RehearsalOptions(planned.seed, 0.2, ARM))
    return report_on(changed, planned, truths, record).metrics


def test_processes_give_way_as_rehearsed_and_keep_the_safe_distance(run: RunFolder) -> None:
    assert rehearsed(run, avoidance=False)["formation"]["min_separation_m"] < SAFE_M
    expected = rehearsed(run, avoidance=True)
    assert expected["formation"]["min_separation_m"] >= SAFE_M
    flown = json.loads(skein("fly", run.path, "--no-corrections", "--json"))
    assert flown["trajectory_sha256"] == expected["trajectory_sha256"]
    assert flown["events"] == expected["events"]
    first, second, *_ = [event for event in flown["events"] if event["sysid"] == 2]
    assert re.fullmatch(r"yielding to UAV 1: \d+ m predicted in \d+ s", first["what"])
    assert second["what"] == "yields no more to UAV 1"
    assert first["what"][1:] in texts(run.logs / "2.tlog")


def texts(tlog: Path) -> str:
    """All that a vehicle has told its station, without the bounds of the wire's pieces."""
    log = mavutil.mavlink_connection(str(tlog))
    pieces = []
    while (message := log.recv_match(type="STATUSTEXT")) is not None:
        pieces.append(message.text)
    return "".join(pieces)
