"""A log tells in which modes a vehicle flew."""

from pathlib import Path

import pytest
from pymavlink.dialects.v20 import ardupilotmega as mavlink

from gcs.console.logged_modes import mode_at, read_modes
from gcs.tlog import TelemetryLog
from sitl.modes import Mode
from sitl.services.codec import Codec
from sitl.services.peer import Message


def heartbeat(mode: Mode, autopilot: int = mavlink.MAV_AUTOPILOT_ARDUPILOTMEGA) -> Message:
    return mavlink.MAVLink_heartbeat_message(mavlink.MAV_TYPE_FIXED_WING, autopilot, 0, mode, 0, 3)


@pytest.fixture
def log(tmp_path: Path) -> Path:
    """Vehicle 3, between a station's heartbeats and messages that tell of other things."""
    vehicle, station = Codec(3, 1), Codec(255, 190)
    path = tmp_path / "3.tlog"
    written = TelemetryLog(path, 1000.0)
    for t_s, mode in ((0.0, Mode.MANUAL), (1.0, Mode.AUTO), (2.0, Mode.AUTO), (9.0, Mode.RTL)):
        written.write(round(1000.0 * t_s), station.pack(heartbeat(Mode.MANUAL, mavlink.MAV_AUTOPILOT_INVALID)))
        written.write(round(1000.0 * t_s), vehicle.pack(heartbeat(mode)))
        written.write(round(1000.0 * t_s), vehicle.pack(mavlink.MAVLink_system_time_message(1, round(1000.0 * t_s))))
    written.close()
    return path


def test_each_change_is_known_and_when_it_was(log: Path) -> None:
    modes = read_modes(log, 3)
    assert [(round(t_s, 3), mode) for t_s, mode in modes] == [(0.0, "MANUAL"), (1.0, "AUTO"), (9.0, "RTL")]
    assert [mode_at(modes, t_s) for t_s in (-1.0, 0.0, 5.0, 9.0, 100.0)] == [None, "MANUAL", "AUTO", "RTL", "RTL"]


def test_of_others_nothing_is_known(log: Path) -> None:
    assert read_modes(log, 4) == []


def test_without_a_log_there_are_no_modes(tmp_path: Path) -> None:
    assert read_modes(tmp_path / "none.tlog", 3) == []
    assert mode_at([], 1.0) is None
