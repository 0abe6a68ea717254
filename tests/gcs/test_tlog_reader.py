"""Reading logs back, damaged as they may be."""

from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from pymavlink.dialects.v20 import ardupilotmega as mavlink

from gcs.tlog import TelemetryLog
from gcs.tlog_reader import read_tlog
from missions.errors import InputError
from sitl.services.codec import Codec
from sitl.services.signing import Signing


@pytest.fixture
def log(tmp_path: Path) -> Path:
    """Ten messages, signed ones and one of version 1 among them."""
    path, codec, key = tmp_path / "3.tlog", Codec(3, 1), Signing(key=bytes(range(32)))
    writer = TelemetryLog(path, 1000.0)
    for number in range(9):
        message = mavlink.MAVLink_system_time_message(number, 1000 * number)
        writer.write(1000 * number, codec.pack(message, key if number % 2 else None))
    old = mavlink.MAVLink_system_time_message(9, 9000)
    writer.write(9000, old.pack(mavlink.MAVLink(None, 3, 1), force_mavlink1=True))
    writer.close()
    return path


def test_what_was_written_is_read(log: Path) -> None:
    assert [(one.time_s, one.message.time_unix_usec) for one in read_tlog(log)] == [(1000.0 + n, n) for n in range(10)]


@pytest.mark.parametrize("cut", [1, 19, 20, 28])
def test_a_cut_end_costs_what_was_cut(log: Path, cut: int) -> None:
    log.write_bytes(log.read_bytes()[:-cut])
    assert [one.message.time_unix_usec for one in read_tlog(log)] == list(range(9))


def test_damage_costs_the_frame_that_it_hits(log: Path) -> None:
    data = bytearray(log.read_bytes())
    data[50] ^= 0xFF
    log.write_bytes(bytes(data[:90]) + b"\xfdnoise\xfe" + bytes(data[90:]))
    read = [one.message.time_unix_usec for one in read_tlog(log)]
    assert read == [0, 3, 4, 5, 6, 7, 8, 9]


@given(st.binary(max_size=500))
def test_any_other_file_is_an_input_error(tmp_path_factory: pytest.TempPathFactory, data: bytes) -> None:
    path = tmp_path_factory.getbasetemp() / "other"
    path.write_bytes(data)
    with pytest.raises(InputError, match="no MAVLink message in it"):
        list(read_tlog(path))


def test_a_file_that_is_not_there_is_an_input_error(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"missing\.tlog: No such file"):
        list(read_tlog(tmp_path / "missing.tlog"))
