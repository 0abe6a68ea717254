"""What is true of telemetry logs."""

import subprocess
import sys
import sysconfig
from pathlib import Path

import pytest
from pymavlink import mavutil
from pymavlink.dialects.v20 import ardupilotmega as mavlink

from gcs.tlog import TelemetryLog
from missions.errors import InputError
from sitl.services.codec import Codec
from sitl.services.signing import Signing


def test_pymavlink_reads_it_while_it_is_being_written(tmp_path: Path) -> None:
    path = tmp_path / "3.tlog"
    log, codec = TelemetryLog(path, 1_700_000_000.0), Codec(3, 1)
    for time_ms in (0, 40, 1_200_000):
        log.write(time_ms, codec.pack(mavlink.MAVLink_system_time_message(0, time_ms)))
    log.flush()
    reader = mavutil.mavlink_connection(str(path))
    messages = [reader.recv_match() for _ in range(3)]
    assert [message.time_boot_ms for message in messages] == [0, 40, 1_200_000]
    stamps_s = [message._timestamp - 1_700_000_000.0 for message in messages]
    assert stamps_s == pytest.approx([0.0, 0.04, 1200.0], abs=1e-5)
    assert reader.recv_match() is None
    reader.close()
    log.close()


def test_mavlogdump_reads_it_while_it_is_being_written(tmp_path: Path) -> None:
    log, codec = TelemetryLog(tmp_path / "3.tlog", 1_700_000_000.0), Codec(3, 1)
    for number in range(20):
        message = mavlink.MAVLink_statustext_message(6, b"line %d" % number)
        log.write(40 * number, codec.pack(message, Signing(key=bytes(range(32))) if number % 2 else None))
    log.flush()
    tool = Path(sysconfig.get_path("scripts")) / "mavlogdump.py"
    command = [sys.executable, str(tool), "--types", "STATUSTEXT", str(tmp_path / "3.tlog")]
    printed = subprocess.run(command, capture_output=True, text=True, check=True, timeout=60).stdout
    assert [line.split("text : ")[1].split(",")[0] for line in printed.splitlines()] == [f"line {n}" for n in range(20)]
    log.close()


def test_what_comes_after_its_end_is_not_written(tmp_path: Path) -> None:
    log = TelemetryLog(tmp_path / "3.tlog", 0.0)
    log.close()
    log.write(0, b"late")
    assert (tmp_path / "3.tlog").read_bytes() == b""


def test_a_folder_that_is_not_there_is_an_input_error(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"3\.tlog: No such file"):
        TelemetryLog(tmp_path / "missing" / "3.tlog", 0.0)


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="needs a device that is always full")
def test_a_full_disk_is_told_not_swallowed() -> None:
    log = TelemetryLog(Path("/dev/full"), 0.0)
    log.check()
    log.write(0, b"frame")
    log.flush()
    with pytest.raises(InputError, match="No space left on device; the log ends early"):
        log.check()
    log.close()
