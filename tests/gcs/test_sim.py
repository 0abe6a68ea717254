"""`skein sim` as an engineer uses it: a foreign station, MAVSDK, uploads a mission to a real endpoint and flies it."""

import re
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import mavsdk
import pytest
from mavsdk.plugins.action import action
from mavsdk.plugins.mission_raw import mission_raw
from pymavlink import mavutil

from missions.scenario import load_scenario
from planner.plan import plan

PATIENCE_S = 20.0


@pytest.fixture
def ports(short_scenario: Path) -> Iterator[list[int]]:
    """TCP ports of two vehicles of `skein sim`, at twenty times real time; Ctrl-C ends them."""
    command = [sys.executable, "-m", "gcs.main", "sim", str(short_scenario), "--count", "2", "--tcp-port", "0"]
    sim = subprocess.Popen([*command, "--speed", "20"], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    assert sim.stdout is not None
    lines = list(iter(sim.stdout.readline, "Ctrl-C ends the simulation.\n"))
    yield [int(port) for line in lines for port in re.findall(r"^│ \d+ .*?127\.0\.0\.1:(\d+) ", line)]
    sim.send_signal(signal.SIGINT)
    _, err = sim.communicate(timeout=20)
    assert sim.returncode == 130, err


def test_mavsdk_uploads_downloads_arms_and_flies(ports: list[int], short_scenario: Path) -> None:
    first, second = ports
    assert first != second
    mission = plan(load_scenario(str(short_scenario))).uavs[0].mission
    sent = [
        mission_raw.MissionItem(
            seq, item.frame, item.command, int(seq == 0), 1, *item.params, item.lat_e7, item.lon_e7, item.alt_m, 0
        )
        for seq, item in enumerate(mission)
    ]
    station = mavsdk.Configuration.create_with_component_type(mavsdk.ComponentType.GROUND_STATION)
    with mavsdk.Mavsdk(station) as sdk:
        assert sdk.add_any_connection(f"tcpout://127.0.0.1:{first}") == mavsdk.ConnectionResult.SUCCESS
        system = sdk.first_autopilot(PATIENCE_S)
        assert system is not None
        missions = mission_raw.MissionRaw(system)
        missions.upload_mission(sent)
        held = missions.download_mission()
        assert [fields(item) for item in held] == [fields(item) for item in sent]
        action.Action(system).arm()
        missions.start_mission()
        deadline = time.monotonic() + 60
        while missions.mission_progress().current < len(mission) - 1:
            assert time.monotonic() < deadline, "the mission was not flown to its end"
            time.sleep(0.1)


def fields(item: Any) -> tuple[Any, ...]:
    """What the wire carries of an item, but for the "current" flag."""
    return (item.seq, item.frame, item.command, item.param1, item.param2, item.param3, item.x, item.y, item.z)


def test_in_real_time_the_clocks_go_by_themselves_and_tell_of_late_and_lost_samples(short_scenario: Path) -> None:
    command = [sys.executable, "-m", "gcs.main", "sim", str(short_scenario), "--count", "2", "--tcp-port", "0"]
    sim = subprocess.Popen([*command, "--real-time"], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    assert sim.stdout is not None
    lines = list(iter(sim.stdout.readline, "Ctrl-C ends the simulation.\n"))
    port = next(int(port) for line in lines for port in re.findall(r"^│ \d+ .*?127\.0\.0\.1:(\d+) ", line))
    station = mavutil.mavlink_connection(f"tcp:127.0.0.1:{port}")
    station.mav.heartbeat_send(6, 8, 0, 0, 0)
    request = (1, 1, mavutil.mavlink.MAV_CMD_REQUEST_MESSAGE, 0, mavutil.mavlink.MAVLINK_MSG_ID_NAMED_VALUE_FLOAT)
    station.mav.command_long_send(*request, *[0.0] * 6)
    times_ms, names = set(), set()
    while len(times_ms) < 2 or "FormLost" not in names:
        message = station.recv_match(blocking=True, timeout=PATIENCE_S)
        assert message is not None, (times_ms, names)
        if message.get_type() == "ATTITUDE":
            times_ms.add(message.time_boot_ms)
        elif message.get_type() == "NAMED_VALUE_FLOAT":
            names.add(message.name)
    station.close()
    sim.send_signal(signal.SIGINT)
    _, err = sim.communicate(timeout=20)
    assert sim.returncode == 130, err
    assert names == {"FormErr", "FormDelay", "FormLate", "FormLost"}
