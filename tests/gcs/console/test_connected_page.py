"""`skein console --connect` in a browser: vehicles that are there, of a swarm that somebody else has started."""

import re
import signal
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Page, expect
from pymavlink import mavutil

from sitl.modes import Mode

ALOFT_MM = 20_000


class Vehicle:
    """One of the swarm, as another station reaches it over TCP."""

    def __init__(self, port: int) -> None:
        self._link = mavutil.mavlink_connection(f"tcp:127.0.0.1:{port}")
        self._link.mav.heartbeat_send(6, 8, 0, 0, 0)
        self.receive("HEARTBEAT")

    def receive(self, kind: str) -> Any:
        message = self._link.recv_match(type=kind, blocking=True, timeout=60.0)
        assert message is not None, f"no {kind}"
        return message

    def take_off(self) -> None:
        """And be in the air."""
        self._command(mavutil.mavlink.MAV_CMD_COMPONENT_ARM_DISARM, 1.0)
        self._command(mavutil.mavlink.MAV_CMD_DO_SET_MODE, 1.0, float(Mode.TAKEOFF))
        while self.receive("GLOBAL_POSITION_INT").relative_alt < ALOFT_MM:
            pass

    def wait_for_mode(self, mode: Mode) -> None:
        while self.receive("HEARTBEAT").custom_mode != mode:
            pass

    def close(self) -> None:
        self._link.close()

    def _command(self, command: int, *params: float) -> None:
        padded = (*params, *[0.0] * (7 - len(params)))
        self._link.mav.command_long_send(self._link.target_system, 1, command, 0, *padded)
        while (ack := self.receive("COMMAND_ACK")).command != command:
            pass
        assert ack.result == mavutil.mavlink.MAV_RESULT_ACCEPTED


@pytest.fixture
def swarm(short_scenario: Path, free_port: Callable[[], int]) -> Iterator[tuple[str, list[Vehicle]]]:
    """Two vehicles of `skein sim`, on the ground, and where their telemetry goes."""
    port = free_port()
    command = [sys.executable, "-m", "gcs.main", "sim", str(short_scenario), "--count", "2", "--tcp-port", "0"]
    sim = subprocess.Popen([*command, "--speed", "10", "--udp", f"127.0.0.1:{port}"], stdout=subprocess.PIPE, text=True)
    assert sim.stdout is not None
    lines = list(iter(sim.stdout.readline, "Ctrl-C ends the simulation.\n"))
    ports = [int(port) for line in lines for port in re.findall(r"^│ \d+ .*?127\.0\.0\.1:(\d+) ", line)]
    vehicles = [Vehicle(port) for port in ports]
    yield f"udpin://127.0.0.1:{port}", vehicles
    for vehicle in vehicles:
        vehicle.close()
    sim.send_signal(signal.SIGINT)
    sim.communicate(timeout=60)
    assert sim.returncode == 130


def test_vehicles_that_are_there_appear_and_obey(
    visit: Callable[[str], Page], start_console: Callable[..., Any], swarm: tuple[str, list[Vehicle]]
) -> None:
    url, vehicles = swarm
    with start_console("--connect", url) as console:
        page = visit(console.address)
        modes = page.locator("table.skein tbody td:nth-child(2)")
        loiter = page.get_by_role("button", name="LOITER", exact=True)
        expect(modes).to_have_text(["MANUAL, disarmed", "MANUAL, disarmed"])
        expect(page.get_by_role("button", name="Hold", exact=True)).to_have_count(0)
        expect(page.get_by_role("tab", name="Network")).to_have_count(0)
        loiter.click()
        expect(page.get_by_text(re.compile("vehicle 1: .*not flying"))).to_be_visible()

        for vehicle in vehicles:
            vehicle.take_off()
        expect(modes).to_have_text(["TAKEOFF", "TAKEOFF"])
        loiter.click()
        expect(modes).to_have_text(["LOITER", "LOITER"])
        expect(page.get_by_text("vehicles 1, 2: LOITER")).to_be_visible()
        for vehicle in vehicles:
            vehicle.wait_for_mode(Mode.LOITER)
        page.close()
