"""Real signals to real processes in flight: killed, stopped, continued; in lockstep and in real time."""

import asyncio
import json
import os
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from gcs.flight import FlightOptions, fly
from gcs.flight_record import FlightRecord
from gcs.run_folder import make_run_folder
from gcs.truth import V, read_truths, trajectory_sha256
from missions.scenario import load_scenario
from planner.plan import plan
from sitl.rehearsal import rehearse
from sitl.swarm import SwarmOptions, vehicle_configs
from sitl.ticks import TICK_S

ROW_BYTES = 48
IN_THE_AIR_TICKS = 400
TICKS = 2000
"""Of a flight, 80 s."""


@pytest.fixture(scope="module")
def line(short_scenario: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The short scenario on a line graph: 1 - 2 - 3."""
    text = short_scenario.read_text()
    file = tmp_path_factory.mktemp("line") / "line.toml"
    file.write_text(text.replace('graph = "ring"', 'graph = "line"'))
    assert load_scenario(str(file)).formation.graph == "line"
    return file


def wait_until(condition: Callable[[], Any], timeout_s: float = 60.0) -> Any:
    deadline = time.monotonic() + timeout_s
    while not (found := condition()):
        assert time.monotonic() < deadline, "it did not happen in time"
        time.sleep(0.005)
    return found


@dataclass
class Demo:
    """A demo in the air."""

    process: "subprocess.Popen[str]"
    run: Path
    pids: dict[int, int]

    def ticks(self, sysid: int) -> int:
        """How far a vehicle has flown, as far as it has been written."""
        return (self.run / "truth" / f"{sysid}.f64").stat().st_size // ROW_BYTES

    def metrics(self) -> dict[str, Any]:
        """What the flight came to, at its end."""
        out, err = self.process.communicate(timeout=100)
        assert out, err
        metrics: dict[str, Any] = json.loads(out)
        return metrics


Start = Callable[..., Demo]


@pytest.fixture
def start(line: Path, tmp_path: Path) -> Iterator[Start]:
    """Starts demos of the line, and returns when they are in the air; nothing of them is left running."""
    demos: list[Demo] = []

    def launch(*options: str) -> Demo:
        run = tmp_path / "run"
        command = [sys.executable, "-m", "gcs.main", "demo", str(line), "--out", str(run), "--json", *options]
        process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        wait_until((run / "endpoints.json").exists, 120.0)
        vehicles = wait_until(lambda: _vehicles(run))
        demo = Demo(process, run, {vehicle["sysid"]: vehicle["pid"] for vehicle in vehicles})
        demos.append(demo)
        wait_until(lambda: all(demo.ticks(sysid) > IN_THE_AIR_TICKS for sysid in demo.pids))
        return demo

    yield launch
    for demo in demos:
        if demo.process.poll() is None:
            demo.process.kill()
            demo.process.communicate()


def _vehicles(run: Path) -> list[dict[str, int]] | None:
    try:
        vehicles: list[dict[str, int]] = json.loads((run / "endpoints.json").read_text())["vehicles"]
    except ValueError:
        return None
    return vehicles


@pytest.mark.parametrize("options", [(), ("--real-time", "--speed", "10")], ids=["lockstep", "real time"])
def test_when_the_middle_of_a_line_is_killed_its_neighbours_find_each_other_and_arrive(
    start: Start, options: tuple[str, ...]
) -> None:
    demo = start(*options)
    os.kill(demo.pids[2], signal.SIGKILL)
    metrics = demo.metrics()
    assert demo.process.returncode == 1
    assert [vehicle["completed"] for vehicle in metrics["vehicles"]] == [True, False, True]
    (lost,) = [event for event in metrics["events"] if "lost" in event["what"]]
    assert (lost["sysid"], lost["what"]) == (2, "lost: process killed by SIGKILL")
    after = [used["edges"] for used in metrics["graph"] if used["t_s"] > lost["t_s"]]
    assert [[1, 3]] in after, "there was no such edge, and they had not heard each other before"


def test_in_real_time_the_others_fly_on_past_one_that_is_stopped_and_it_rejoins_without_a_jump(start: Start) -> None:
    demo = start("--real-time", "--speed", "10")
    os.kill(demo.pids[2], signal.SIGSTOP)
    stopped_at = demo.ticks(2)
    wait_until(lambda: min(demo.ticks(1), demo.ticks(3)) > stopped_at + 700)  # so many that it has gone
    assert demo.ticks(2) <= stopped_at + 100, "what was being written"
    os.kill(demo.pids[2], signal.SIGCONT)
    metrics = demo.metrics()
    assert demo.process.returncode == 0, metrics
    assert metrics["trajectory_sha256"] is None, "no other flight will be the same"
    truths = read_truths(demo.run / "truth", [1, 2, 3])
    for truth in truths.values():
        assert np.abs(np.diff(truth[:, :3], axis=0)).max() < 40.0 * TICK_S, "each tick is flown"
        assert np.abs(np.diff(truth[:, V])).max() < 1.0
    without = [used["t_s"] for used in metrics["graph"] if [1, 2] not in used["edges"] and used["t_s"] > 10.0]
    again = [used["t_s"] for used in metrics["graph"] if [1, 2] in used["edges"]]
    assert min(without) < max(again), "it was left out, and taken in again"
    formation, links = metrics["formation"], metrics["links"]
    assert {(1, 2), (2, 1), (2, 3), (3, 2)} <= {(link["sender"], link["receiver"]) for link in links}
    assert formation["late_samples"] == sum(link["late"] for link in links) > 0
    assert formation["lost_samples"] == sum(link["lost"] for link in links)
    assert formation["measured_delay_s"] > 0.2, "the injected delay, and the real one"
    assert metrics["behind_s"] > 1.0


def test_in_lockstep_the_swarm_waits_for_one_that_is_stopped_and_the_station_names_it(
    line: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("gcs.watch.SILENT_S", 3.0)
    scenario = load_scenario(str(line))
    planned = plan(scenario)
    run = make_run_folder(tmp_path / "run", scenario.name)
    said: list[str] = []
    records: list[FlightRecord] = []
    options = FlightOptions(delay_s=0.2, speed=50.0)

    def flight() -> None:
        records.append(asyncio.run(fly(scenario, planned, run, options, said.append, lambda statuses: None)))

    thread = threading.Thread(target=flight)
    thread.start()
    truth = {i: run.truth / f"{i}.f64" for i in (1, 2, 3)}
    wait_until(lambda: all(f.exists() and f.stat().st_size > IN_THE_AIR_TICKS * ROW_BYTES for f in truth.values()))
    (pid,) = [vehicle["pid"] for vehicle in _vehicles(run.path) or [] if vehicle["sysid"] == 2]
    os.kill(pid, signal.SIGSTOP)
    try:
        wait_until(lambda: "vehicle 2 has not answered for 3 s" in said)
        sizes = {i: file.stat().st_size for i, file in truth.items()}
        assert max(sizes.values()) - min(sizes.values()) < 1000 * ROW_BYTES, "nobody has flown on"
    finally:
        os.kill(pid, signal.SIGCONT)
    thread.join(60)
    (record,) = records
    assert {"has not answered for 3 s", "answers again"} <= {e.what for e in record.events if e.sysid == 2}
    vehicles = vehicle_configs(scenario, SwarmOptions(seed=planned.seed, delay_s=0.2))
    rehearsed = rehearse(vehicles, {uav.sysid: uav.mission for uav in planned.uavs}).truth
    flown = read_truths(run.truth, rehearsed)
    assert trajectory_sha256(flown, TICKS) == trajectory_sha256(rehearsed, TICKS), "the same flight, bit for bit"
