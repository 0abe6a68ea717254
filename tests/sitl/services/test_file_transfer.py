"""Requests for files are refused at once."""

import struct
from typing import Any

import pytest
from pymavlink.dialects.v20 import ardupilotmega as mavlink

HEADER = struct.Struct("<HBBBBBBI")


def request(seq: int, opcode: int) -> Any:
    payload = HEADER.pack(seq, 3, opcode, 20, 0, 0, 0, 0) + b"@PARAM/param.pck"
    return mavlink.MAVLink_file_transfer_protocol_message(0, 3, 1, list(payload.ljust(251, b"\0")))


@pytest.mark.parametrize(("seq", "next_seq"), [(0, 1), (255, 256), (65535, 0)])
def test_a_request_is_answered_by_nak_unknown_command(bench: Any, seq: int, next_seq: int) -> None:
    (answer,) = bench.tell(request(seq, 4))
    assert (answer.target_system, answer.target_component) == (255, 190)
    header = HEADER.unpack_from(bytes(answer.payload))
    assert header == (next_seq, 3, 129, 1, 4, 0, 0, 0)
    assert answer.payload[HEADER.size] == 7


def test_answers_are_not_answered(bench: Any) -> None:
    assert bench.tell(request(1, 128)) == bench.tell(request(1, 129)) == []
