"""A swarm on machines that are far apart: a router between them, over wires that delay and lose packets."""

import signal
import subprocess
import sys
import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack
from pathlib import Path
from typing import Any

import pytest
from pymavlink import mavutil

SKEIN = (sys.executable, "-m", "gcs.main")
SPEED = 10
WIRE_S, LOSS = 0.005, 0.01
"""Each way. A sample crosses two wires, to the router and from it."""
INJECTED_S = 0.2
"""By the scenario."""
STATION, EAR = "127.0.0.1:14550", "127.0.0.1:14551"
"""On each machine: where the operator's commands listen, and where the test does."""
PATIENCE_S = 180.0


@pytest.mark.parametrize("wire", ["netem", "tun"])
def test_the_real_delay_comes_on_top_of_the_injected_one_and_all_arrive(
    make_place: Callable[..., Any], wire: str, short_scenario: Path, tmp_path: Path
) -> None:
    place = make_place(wire, 2, WIRE_S, LOSS)
    middle, (first, second) = place.middle, place.others
    run = tmp_path / "run"
    subprocess.run([*SKEIN, "plan", str(short_scenario), "--out", str(run)], check=True, stdout=subprocess.PIPE)
    with ExitStack() as stack:

        def launch(machine: Any, *arguments: object) -> "subprocess.Popen[str]":
            process = subprocess.Popen(machine.command(*SKEIN, *arguments), stdout=subprocess.PIPE, text=True)
            stack.callback(process.communicate, timeout=30)
            stack.callback(process.send_signal, signal.SIGINT)
            return process

        def wait_for(text: str, process: "subprocess.Popen[str]") -> None:
            assert process.stdout is not None
            assert any(text in line for line in process.stdout), f"{process.args} ended early"

        def field(router: str) -> Path:
            file = tmp_path / f"{router}.toml"
            file.write_text(f'swarm = "field"\nrouter = "tcp/{router}:7447"\n')
            return file

        wait_for("Router of field", launch(middle, "router", field("0.0.0.0")))
        common = (
            "sim",
            short_scenario,
            "--real-time",
            "--speed",
            SPEED,
            "--tcp-port",
            0,
            "--udp",
            STATION,
            "--udp",
            EAR,
        )
        ends = ((first, place.addresses[0], "1"), (second, place.addresses[1], "2,3"))
        sims = [
            launch(
                machine,
                *(*common, "--vehicle", vehicles, "--zenoh", field(address)),
                *("--state", tmp_path / vehicles),
            )
            for machine, address, vehicles in ends
        ]
        for sim in sims:
            wait_for("Ctrl-C ends", sim)
        both = stack.enter_context(ThreadPoolExecutor())
        # From before the start: at this speed it is soon over, and nobody tells of delays after that.
        ears = [both.submit(_delays_of_the_flight, *end) for end in ((first, {1}), (second, {2, 3}))]
        for order in (("upload", run), ("mode", "AUTO"), ("arm",)):
            given = [
                subprocess.Popen(machine.command(*SKEIN, *order, "--vehicle", vehicles), stdout=subprocess.PIPE)
                for machine, _, vehicles in ends
            ]
            for process in given:
                said, _ = process.communicate(timeout=PATIENCE_S)
                assert process.returncode == 0, said
        delays_s = [delay_s for ear in ears for delay_s in ear.result()]
    network_s = 2 * WIRE_S * SPEED
    assert min(delays_s) > INJECTED_S + 0.9 * network_s


def _delays_of_the_flight(machine: Any, sysids: set[int]) -> list[float]:
    """The mean delay in simulated seconds that each of a machine's vehicles has measured once its mission is flown."""
    station = machine.here(lambda: mavutil.mavlink_connection(f"udpin:{EAR}"))
    delays_s: dict[int, float] = {}
    flown: set[int] = set()
    deadline = time.monotonic() + PATIENCE_S
    while not flown == sysids == delays_s.keys():
        message = station.recv_match(type=["NAMED_VALUE_FLOAT", "MISSION_CURRENT"], blocking=True, timeout=1.0)
        assert time.monotonic() < deadline, (delays_s, flown)
        if message is None:
            continue
        if message.get_type() == "MISSION_CURRENT":
            if message.mission_state == mavutil.mavlink.MISSION_STATE_COMPLETE:
                flown.add(message.get_srcSystem())
        elif message.name == "FormDelay":
            delays_s[message.get_srcSystem()] = message.value
    station.close()
    return list(delays_s.values())
