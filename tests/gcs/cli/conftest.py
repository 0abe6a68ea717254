"""Commands run as a user runs them, on swarms of `skein sim`: processes of their own, real sockets, free ports."""

import json
import os
import re
import signal
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest
from typer.testing import CliRunner, Result

from gcs.cli import app
from gcs.run_folder import make_run_folder
from missions.scenario import load_scenario
from planner.plan import plan

READY = "Ctrl-C ends the simulation.\n"
_ROW = re.compile(r"^│ (\d+) .*?127\.0\.0\.1:(\d+) .* (\d+) │$", re.M)


def run_skein(*arguments: object) -> Result:
    """Run one command in this process."""
    terminate = signal.getsignal(signal.SIGTERM)
    try:
        return CliRunner().invoke(app, [str(argument) for argument in arguments])
    finally:
        signal.signal(signal.SIGTERM, terminate)


def command_of_sim(scenario: Path, *options: object) -> list[str]:
    """What starts a swarm on free TCP ports."""
    return [sys.executable, "-m", "gcs.main", "sim", str(scenario), "--tcp-port", "0", *map(str, options)]


@dataclass(frozen=True)
class Sim:
    """A running `skein sim`.

    Attributes:
        process: its own.
        printed: what it said before it was ready.
        udp: URL of where its telemetry goes.
        tcp: URL of each vehicle, by system id.
        pids: process of each vehicle, by system id.
    """

    process: subprocess.Popen[str]
    printed: str
    udp: str
    tcp: dict[int, str]
    pids: dict[int, int]

    def __call__(self, *arguments: object) -> Result:
        """Run a command of an operator, connected to every vehicle."""
        return run_skein(*arguments, *(word for url in self.tcp.values() for word in ("--connect", url)))

    def json(self, *arguments: object) -> dict[int, Any]:
        """Run one that is to succeed with --json; what it says of each vehicle."""
        result = self(*arguments, "--json")
        assert result.exit_code == 0, result.output
        rows = json.loads(result.stdout)["vehicles"]
        assert all(row["ok"] for row in rows)
        return {row["sysid"]: row["result"] for row in rows}


@contextmanager
def running(scenario: Path, state_home: Path, port: int, *options: object) -> Iterator[Sim]:
    """A swarm, from its start to its Ctrl-C."""
    process = subprocess.Popen(
        command_of_sim(scenario, "--udp", f"127.0.0.1:{port}", *options),
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        env=os.environ | {"XDG_STATE_HOME": str(state_home)},
    )
    assert process.stdout is not None
    try:
        printed = "".join(iter(process.stdout.readline, READY))
        rows = [tuple(map(int, row)) for row in _ROW.findall(printed)]
        tcp = {sysid: f"tcp://127.0.0.1:{tcp_port}" for sysid, tcp_port, _ in rows}
        yield Sim(process, printed, f"udpin://127.0.0.1:{port}", tcp, {sysid: pid for sysid, _, pid in rows})
    finally:
        process.send_signal(signal.SIGINT)
        _, err = process.communicate(timeout=20)
    assert process.returncode == 130, err


@pytest.fixture(scope="session")
def skein() -> Callable[..., Result]:
    return run_skein


@pytest.fixture(scope="session")
def sim_command() -> Callable[..., list[str]]:
    return command_of_sim


@pytest.fixture(scope="session")
def state_home(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("state")


@pytest.fixture(scope="session")
def start_sim(short_scenario: Path, state_home: Path, free_port: Callable[[], int]) -> Callable[..., Any]:
    """Swarms of the short scenario, by the options of `skein sim`, as contexts."""
    return lambda *options: running(short_scenario, state_home, free_port(), *options)


@pytest.fixture(scope="module")
def swarm(start_sim: Callable[..., Any]) -> Iterator[Sim]:
    """Three vehicles at ten times real time."""
    with start_sim("--speed", 10, "--wipe") as sim:
        assert list(sim.tcp) == [1, 2, 3]
        yield sim


@pytest.fixture(scope="session")
def run_folder(short_scenario: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A planned run of the short scenario."""
    scenario = load_scenario(str(short_scenario))
    run = make_run_folder(tmp_path_factory.mktemp("runs") / "short", scenario.name)
    run.write_plan(short_scenario.read_text(), scenario, plan(scenario))
    return run.path
