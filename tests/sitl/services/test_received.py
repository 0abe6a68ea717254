"""Received messages are what pymavlink makes of the same frames, for every message of the dialect."""

import copy
import math
import random
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from pymavlink.dialects.v20 import ardupilotmega as mavlink

from sitl.services.codec import Codec
from sitl.services.received import KINDS, Received

LAYOUTS = list(mavlink.mavlink_map.values())


def frame_of(layout: Any, payload: bytes, *, version: int = 2) -> bytes:
    """A frame with any payload at all, of any length."""
    if version == 1:
        body = bytes([len(payload), 9, 3, 1, layout.id])
        start = b"\xfe"
    else:
        body = bytes([len(payload), 0, 0, 9, 3, 1]) + layout.id.to_bytes(3, "little")
        start = b"\xfd"
    crc = mavlink.x25crc(bytearray(body + payload + bytes([layout.crc_extra]))).crc
    return start + body + payload + crc.to_bytes(2, "little")


def same(ours: Any, theirs: Any) -> bool:
    if isinstance(theirs, list):
        return len(ours) == len(theirs) and all(map(same, ours, theirs))
    if isinstance(theirs, float) and math.isnan(theirs):
        return math.isnan(ours)
    return type(ours) is type(theirs) and ours == theirs


def assert_same(frame: bytes) -> None:
    (ours,) = Codec(255, 190).feed(frame)
    theirs = mavlink.MAVLink(None).decode(bytearray(frame))
    for ask in ("get_type", "get_msgId", "get_seq", "get_srcSystem", "get_srcComponent"):
        assert getattr(ours, ask)() == getattr(theirs, ask)()
    assert bytes(ours.get_msgbuf()) == bytes(theirs.get_msgbuf()) == frame
    assert ours.time_boot_ms_or(-1) == getattr(theirs, "time_boot_ms", -1)
    for name in theirs.get_fieldnames():
        assert same(getattr(ours, name), getattr(theirs, name)), (ours.get_type(), name)


@pytest.mark.parametrize("version", [1, 2])
def test_every_message_of_the_dialect_with_every_length_of_payload(version: int) -> None:
    rng = random.Random(7)
    for layout in LAYOUTS:
        if version == 1 and layout.id > 255:
            continue
        size = layout.unpacker.size
        for length in {size, 0, 1, size // 2, size - 1, min(255, size + 5)}:
            assert_same(frame_of(layout, rng.randbytes(max(0, length)), version=version))


@settings(max_examples=300)
@given(st.sampled_from(LAYOUTS), st.binary(max_size=255), st.sampled_from([1, 2]))
def test_any_payload_at_all(layout: Any, payload: bytes, version: int) -> None:
    assert_same(frame_of(layout, payload, version=version if layout.id < 256 else 2))


@given(st.text(st.characters(max_codepoint=126, min_codepoint=1), max_size=50))
def test_texts_end_at_their_first_nul(text: str) -> None:
    frame = Codec(3, 1).pack(mavlink.MAVLink_statustext_message(4, text.encode()))
    assert Codec(255, 190).feed(frame)[0].text == text


def test_what_a_message_has_not_is_an_attribute_error() -> None:
    (message,) = Codec(255, 190).feed(Codec(3, 1).pack(mavlink.MAVLink_heartbeat_message(1, 3, 81, 10, 3, 3)))
    assert getattr(message, "target_system", 0) == 0
    assert message.time_boot_ms_or(5) == 5
    assert "custom_mode" in repr(message)
    assert copy.copy(message).custom_mode == 10


def test_a_field_is_decoded_once() -> None:
    kind = KINDS[mavlink.MAVLINK_MSG_ID_ATTITUDE]
    message = Received(kind, frame_of(mavlink.MAVLink_attitude_message, bytes(28)))
    assert not message.__dict__
    assert message.roll == 0.0
    assert set(message.__dict__) == {name for name, _, _ in kind.fields}
