"""The whole way, as a user goes it: real processes, real sockets, real Zenoh, through the command line."""

import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from pymavlink import mavutil

from gcs.flight_record import FlightRecord, Timing
from gcs.metrics import measure
from gcs.rehearsal import RehearsalOptions, rehearse_plan
from gcs.report import report_on
from gcs.run_folder import RunFolder
from gcs.truth import read_truths
from sitl.config import Arm
from sitl.formation.graph import edges

SKEIN = (sys.executable, "-m", "gcs.main")
VEHICLE_KEYS = {
    "sysid", "name", "fitness", "fitness_terms", "straight_line_km", "planned_length_km", "flown_length_km",
    "planned_arrival_s", "arrival_s", "completed", "items_uploaded", "items_verified",
}  # fmt: skip
FORMATION_KEYS = {
    "delay_margin_s", "rms_error_m", "max_error_m", "arrival_spread_s", "min_separation_m", "min_clearance_m",
    "radar_exposure_s", "late_samples", "lost_samples",
}  # fmt: skip
TIMING_KEYS = {"compile_s", "plan_s", "startup_s", "upload_s", "flight_wall_s", "flight_sim_s", "real_time_factor"}


def skein(*arguments: object) -> "subprocess.CompletedProcess[str]":
    return subprocess.run([*SKEIN, *map(str, arguments)], capture_output=True, text=True, timeout=200)


def wait_until(condition: Callable[[], Any], timeout_s: float = 60.0) -> Any:
    deadline = time.monotonic() + timeout_s
    while not (found := condition()):
        assert time.monotonic() < deadline, "it did not happen in time"
        time.sleep(0.02)
    return found


def alive(pid: int) -> bool:
    try:
        return Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()[0] != "Z"
    except FileNotFoundError:
        return False


def endpoints(run: Path) -> list[dict[str, int]]:
    """What endpoints.json says, once it is there."""

    def read() -> list[dict[str, int]] | None:
        try:
            vehicles: list[dict[str, int]] = json.loads((run / "endpoints.json").read_text())["vehicles"]
        except (FileNotFoundError, ValueError):
            return None
        return vehicles

    found: list[dict[str, int]] = wait_until(read)
    return found


@pytest.fixture(scope="module")
def flown(short_scenario: Path, tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, dict[str, Any]]:
    """A run of the short scenario, and what the command printed."""
    run = tmp_path_factory.mktemp("runs") / "first"
    result = skein("demo", short_scenario, "--out", run, "--json")
    assert result.returncode == 0, result.stderr
    return run, json.loads(result.stdout)


Flown = tuple[Path, dict[str, Any]]


def test_a_run_holds_all_that_the_design_says(flown: Flown) -> None:
    run, _ = flown
    assert {"scenario.toml", "plan.json", "endpoints.json", "metrics.json"} <= {entry.name for entry in run.iterdir()}
    assert sorted(file.name for file in (run / "truth").iterdir()) == ["1.f64", "2.f64", "3.f64"]
    assert sorted(file.name for file in (run / "logs").iterdir()) == ["1.tlog", "2.tlog", "3.tlog"]
    assert {file.suffix for file in (run / "missions").iterdir()} == {".plan", ".waypoints"}
    assert len(list((run / "figures").glob("*.png"))) >= 4


def test_metrics_have_the_promised_keys_and_all_vehicles_completed(flown: Flown) -> None:
    run, printed = flown
    metrics = json.loads((run / "metrics.json").read_text())
    assert {**metrics, "run": str(run)} == printed
    assert {"scenario", "seed", "delay_s", "trajectory_sha256", "events"} <= metrics.keys()
    assert all(vehicle.keys() >= VEHICLE_KEYS for vehicle in metrics["vehicles"])
    assert metrics["formation"].keys() >= FORMATION_KEYS
    assert metrics["timing"].keys() >= TIMING_KEYS
    assert all(vehicle["completed"] for vehicle in metrics["vehicles"])
    assert all(vehicle["items_verified"] == vehicle["items_uploaded"] > 0 for vehicle in metrics["vehicles"])
    assert metrics["formation"]["late_samples"] == 0
    assert len(metrics["trajectory_sha256"]) == 64


def test_what_concerns_the_flight_can_be_recomputed_from_truth_and_plan(flown: Flown) -> None:
    run, metrics = flown
    scenario, plan = RunFolder(run).read()
    sysids = [uav.sysid for uav in plan.uavs]
    again, _ = measure(
        scenario,
        plan,
        read_truths(run / "truth", sysids),
        edges(scenario.formation.graph, sysids),
        FlightRecord(
            seed=plan.seed,
            delay_s=metrics["delay_s"],
            arm="full",
            items_uploaded={},
            items_verified={},
            timing=Timing(**metrics["timing"]),
            events=(),
            lost={},
            delay_margin_s=metrics["formation"]["delay_margin_s"],
        ),
    )
    recomputed = again.as_json()
    assert recomputed["formation"] == metrics["formation"]
    assert recomputed["events"] == metrics["events"]
    assert recomputed["trajectory_sha256"] == metrics["trajectory_sha256"]
    for mine, theirs in zip(recomputed["vehicles"], metrics["vehicles"], strict=True):
        kept = VEHICLE_KEYS - {"items_uploaded", "items_verified"}
        assert {key: mine[key] for key in kept} == {key: theirs[key] for key in kept}


def test_telemetry_logs_tell_the_flight_in_simulated_time(flown: Flown) -> None:
    run, metrics = flown
    log = mavutil.mavlink_connection(str(run / "logs" / "2.tlog"))
    stamps, boot_s, kinds, x_e7 = [], [], set(), []
    while (message := log.recv_msg()) is not None:
        if message.get_srcSystem() == 2:
            kinds.add(message.get_type())
            if message.get_type() == "GLOBAL_POSITION_INT":
                stamps.append(message._timestamp)
                boot_s.append(message.time_boot_ms / 1000)
                x_e7.append(message.lon)
    log.close()
    assert {"HEARTBEAT", "GLOBAL_POSITION_INT", "MISSION_ITEM_REACHED", "MISSION_ACK", "STATUSTEXT"} <= kinds
    assert np.subtract(stamps, stamps[0]) == pytest.approx(np.subtract(boot_s, boot_s[0]), abs=1e-3)
    assert boot_s[-1] >= metrics["vehicles"][1]["arrival_s"]
    assert np.all(np.diff(x_e7[:80]) >= 0), "it flew east"
    assert x_e7[79] > x_e7[0]


def test_the_same_again_and_with_another_seed_or_delay(flown: Flown, short_scenario: Path, tmp_path: Path) -> None:
    run, first = flown
    hashes = {}
    for name, options in {"seed": ("--seed", 2), "delay": ("--delay", 0.24)}.items():
        result = skein("demo", short_scenario, "--out", tmp_path / name, "--json", *options)
        assert result.returncode == 0, result.stderr
        hashes[name] = json.loads(result.stdout)["trajectory_sha256"]
    assert rehearsed(run)["trajectory_sha256"] == first["trajectory_sha256"]
    assert len({first["trajectory_sha256"], hashes["seed"], hashes["delay"]}) == 3
    again = rehearsed(short_scenario, "--seed", 2, "--out", tmp_path / "rehearsed")
    assert again["trajectory_sha256"] == hashes["seed"]
    assert_same_flight(again, json.loads((tmp_path / "seed" / "metrics.json").read_text()))
    for file in ("1.f64", "2.f64", "3.f64"):
        ours, theirs = ((tmp_path / run / "truth" / file).read_bytes() for run in ("rehearsed", "seed"))
        shorter = min(len(ours), len(theirs))
        assert ours[:shorter] == theirs[:shorter]
    assert rehearsed(run, "--delay", 0.24)["trajectory_sha256"] == hashes["delay"]


def rehearsed(*arguments: object) -> dict[str, Any]:
    """What the command that flies in one process prints."""
    result = skein("rehearse", *arguments, "--json")
    assert result.returncode == 0, result.stderr
    metrics: dict[str, Any] = json.loads(result.stdout)
    return metrics


def assert_same_flight(rehearsal: dict[str, Any], flight: dict[str, Any]) -> None:
    """The same keys and figures; what only endpoints have is null."""
    assert rehearsal.keys() == {"run", *flight}
    assert rehearsal["timing"].keys() == flight["timing"].keys()
    assert rehearsal["timing"]["startup_s"] is rehearsal["timing"]["upload_s"] is None
    assert rehearsal["formation"] == flight["formation"]
    assert rehearsal["limits"] == flight["limits"]
    assert rehearsal["events"] == flight["events"]
    only = dict.fromkeys(("items_uploaded", "items_verified"))
    assert rehearsal["vehicles"] == [vehicle | only for vehicle in flight["vehicles"]]


NETWORK = """
[channel]
jitter_s = 0.2
loss = 0.15
bursts = { every_s = 15.0, length_s = 2.0 }

[[links]]
from = 2
to = 3
delay_s = 0.36

[[failures]]
what = "split"
at_s = 10.0
for_s = 8.0
groups = [[1, 2]]

[[failures]]
what = "freeze"
at_s = 30.0
for_s = 5.0
vehicles = [3]

[[failures]]
what = "silence"
at_s = 40.0
for_s = 4.0

[[failures]]
what = "kill"
at_s = 50.0
vehicles = [2]
"""


def test_a_flight_of_lost_messages_and_failures_is_the_rehearsed_one_at_any_speed(
    short_scenario: Path, tmp_path: Path
) -> None:
    scenario = tmp_path / "failing.toml"
    text = short_scenario.read_text().replace('graph = "ring"', 'graph = "line"')
    scenario.write_text(text.replace("[wind]", NETWORK + "\n[wind]"))
    expected = rehearsed(scenario, "--out", tmp_path / "rehearsed")
    flown = []
    for speed in (0, 30):
        result = skein("fly", tmp_path / "rehearsed", "--speed", speed, "--json")
        assert result.returncode == 0, result.stderr
        flown.append(json.loads(result.stdout))
        assert flown[-1]["trajectory_sha256"] == expected["trajectory_sha256"]
    killed, survivors = flown[0]["vehicles"][1], (flown[0]["vehicles"][0], flown[0]["vehicles"][2])
    assert (killed["lost_s"], killed["completed"]) == (50.0, False)
    assert all(vehicle["completed"] for vehicle in survivors)
    graphs = [graph["edges"] for graph in flown[0]["graph"]]
    assert [[1, 2], [2, 3]] in graphs, "a line at first"
    assert [[1, 3]] in graphs, "mended when the one in the middle is gone"
    known = [graph["t_s"] for graph in flown[0]["graph"] if [1, 3] in graph["edges"]]
    assert min(known) > 50.0
    assert expected["events"] == flown[0]["events"]


def test_a_planned_run_is_flown_and_its_missions_exported(short_scenario: Path, tmp_path: Path) -> None:
    run = tmp_path / "run"
    assert skein("plan", short_scenario, "--out", run).returncode == 0
    plain = skein("fly", run, "--no-corrections", "--json")
    assert plain.returncode == 0, plain.stderr
    assert json.loads(plain.stdout)["arm"] == "plain"
    assert rehearsed_sha256(run, "plain") == json.loads(plain.stdout)["trajectory_sha256"]
    alone = skein("fly", run, "--no-neighbours", "--json")
    assert json.loads(alone.stdout)["formation"]["rms_error_m"] < json.loads(plain.stdout)["formation"]["rms_error_m"]
    assert rehearsed_sha256(run, "own_schedule") == json.loads(alone.stdout)["trajectory_sha256"]
    out = tmp_path / "missions"
    assert skein("export", run, "--format", "waypoints", "--out", out).returncode == 0
    assert [file.read_text()[:11] for file in sorted(out.iterdir())] == ["QGC WPL 110"] * 3


def rehearsed_sha256(run: Path, arm: Arm) -> str | None:
    """Of the rehearsal of a planned run."""
    scenario, plan = RunFolder(run).read()
    truths, record = rehearse_plan(scenario, plan, RehearsalOptions(plan.seed, scenario.formation.delay_s, arm))
    return report_on(scenario, plan, truths, record).metrics["trajectory_sha256"]  # type: ignore[no-any-return]


@pytest.fixture
def slow_flight(
    short_scenario: Path, tmp_path: Path
) -> Iterator[tuple["subprocess.Popen[str]", Path, list[dict[str, int]]]]:
    """A demo at ten times real time, in the air; afterwards nothing of it may be left."""
    run = tmp_path / "slow"
    command = [*SKEIN, "demo", str(short_scenario), "--out", str(run), "--speed", "10", "--json"]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    vehicles = endpoints(run)
    wait_until(lambda: all((run / "truth" / f"{v['sysid']}.f64").stat().st_size > 20_000 for v in vehicles))
    yield process, run, vehicles
    wait_until(lambda: not any(alive(vehicle["pid"]) for vehicle in vehicles))
    if process.poll() is None:
        process.kill()
    process.communicate()


Slow = tuple["subprocess.Popen[str]", Path, list[dict[str, int]]]


def test_a_vehicle_killed_in_flight_is_named_and_the_others_finish(slow_flight: Slow) -> None:
    process, _, vehicles = slow_flight
    os.kill(vehicles[1]["pid"], signal.SIGKILL)
    out, err = process.communicate(timeout=60)
    assert process.returncode == 1, err
    metrics = json.loads(out)
    assert [vehicle["completed"] for vehicle in metrics["vehicles"]] == [True, False, True]
    assert metrics["trajectory_sha256"] is None
    assert [event["what"] for event in metrics["events"]].count("arrived") == 2
    (lost,) = [event for event in metrics["events"] if "lost" in event["what"]]
    assert lost["sysid"] == vehicles[1]["sysid"]
    assert "SIGKILL" in lost["what"]
    assert 5 < lost["t_s"] < 86


def test_ctrl_c_ends_everything_with_130(slow_flight: Slow) -> None:
    process, _, _ = slow_flight
    process.send_signal(signal.SIGINT)
    _, err = process.communicate(timeout=30)
    assert process.returncode == 130
    assert "interrupted" in err
    assert "Traceback" not in err


def test_sigterm_ends_everything_with_143(slow_flight: Slow) -> None:
    process, _, _ = slow_flight
    process.terminate()
    _, err = process.communicate(timeout=30)
    assert process.returncode == 143
    assert "Traceback" not in err


def test_the_stations_death_ends_everything(slow_flight: Slow) -> None:
    process, _, _ = slow_flight
    process.kill()
    process.communicate()
