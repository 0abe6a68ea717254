"""A swarm on several machines, each a `skein sim` of its own, at a `skein router`; here all on one."""

import json
import signal
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import ExitStack
from pathlib import Path

import pytest
import zenoh

from gcs.zenoh_file import read_zenoh_file
from sitl.formation.correction import decode
from sitl.zenoh_network import STATION
from sitl.zenoh_session import clock_key, correction_key, open_session

SKEIN = (sys.executable, "-m", "gcs.main")


@pytest.fixture
def field(tmp_path: Path, free_port: Callable[[], int]) -> Path:
    file = tmp_path / "field.toml"
    file.write_text(f'swarm = "field"\nrouter = "tcp/127.0.0.1:{free_port()}"\n')
    return file


@pytest.fixture
def stack() -> Iterator[ExitStack]:
    """Ends what it is given, last first."""
    with ExitStack() as stack:
        yield stack


def launch(stack: ExitStack, *arguments: object) -> "subprocess.Popen[str]":
    """Start a command; it is interrupted at the end, and must end well."""
    process = subprocess.Popen([*SKEIN, *map(str, arguments)], stdout=subprocess.PIPE, text=True)

    def end() -> None:
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=30)
        assert process.returncode == 130

    stack.callback(end)
    return process


def wait_for(text: str, process: "subprocess.Popen[str]") -> None:
    assert process.stdout is not None
    assert any(text in line for line in process.stdout), f"{process.args} ended early"


def test_vehicles_of_two_machines_are_one_swarm_with_one_clock(
    field: Path, short_scenario: Path, tmp_path: Path, stack: ExitStack
) -> None:
    wait_for("Router of field", launch(stack, "router", field))
    common = ("sim", short_scenario, "--zenoh", field, "--real-time", "--tcp-port", 0, "--udp", "127.0.0.1:9")
    second = launch(stack, *common, "--vehicle", "2,3", "--state", tmp_path / "second")
    first = launch(stack, *common, "--vehicle", "1", "--state", tmp_path / "first")
    for machine in (first, second):
        wait_for("Ctrl-C ends", machine)
    with open_session(read_zenoh_file(field).client(STATION)) as session:
        every = {"target": zenoh.QueryTarget.ALL, "consolidation": zenoh.ConsolidationMode.NONE}
        states = [json.loads(reply.ok.payload.to_bytes()) for reply in session.get(clock_key("field"), **every)]
        assert sorted(state["sysid"] for state in states) == [1, 2, 3]
        assert not any(state["held"] for state in states)
        heard = session.declare_subscriber(correction_key("field", 3)).recv()
        assert {sample.sysid for sample in decode(heard.payload.to_bytes())} == {3}


def test_a_vehicle_that_the_swarm_has_not_is_named(field: Path, short_scenario: Path, stack: ExitStack) -> None:
    wait_for("Router of field", launch(stack, "router", field))
    command = [*SKEIN, "sim", str(short_scenario), "--zenoh", str(field), "--vehicle", "2,7", "--tcp-port", "0"]
    result = subprocess.run(command, capture_output=True, text=True, timeout=60)
    assert result.returncode == 2
    assert "vehicles [7]: not in this swarm; it has [1, 2, 3]" in result.stderr


def test_without_its_router_a_swarm_says_where_it_looked(field: Path, short_scenario: Path, tmp_path: Path) -> None:
    command = [*SKEIN, "sim", str(short_scenario), "--zenoh", str(field), "--tcp-port", "0", "--state", str(tmp_path)]
    result = subprocess.run(command, capture_output=True, text=True, timeout=60)
    assert result.returncode == 2
    assert "no router answers there" in result.stderr
