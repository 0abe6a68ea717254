"""What is true of the frames of one peer."""

from typing import Any

from fastcrc.crc16 import mcrf4xx
from hypothesis import given, settings
from hypothesis import strategies as st
from pymavlink.dialects.v20 import ardupilotmega as mavlink

from sitl.services.codec import Codec
from sitl.services.signing import Signing


def heartbeat() -> mavlink.MAVLink_message:
    return mavlink.MAVLink_heartbeat_message(1, 3, 81, 10, 3, 3)


@given(st.lists(st.binary(max_size=40), max_size=5))
def test_garbage_never_raises_and_never_swallows_the_frames_around_it(pieces: list[bytes]) -> None:
    codec, reader = Codec(7, 1), Codec(255, 190)
    garbage = [piece.replace(b"\xfd", b"").replace(b"\xfe", b"") for piece in pieces]
    data = b"".join(piece + codec.pack(heartbeat()) for piece in garbage)
    messages = reader.feed(data)
    assert [message.get_seq() for message in messages] == list(range(len(pieces)))
    assert reader.skipped_bytes == sum(map(len, garbage))


@given(st.binary(max_size=400))
def test_any_bytes_at_all_leave_the_codec_able_to_read(data: bytes) -> None:
    codec, reader = Codec(7, 1), Codec(255, 190)
    reader.feed(data)
    frames = b"".join(
        codec.pack(heartbeat()) for _ in range(20)
    )  # more than the longest frame that garbage can promise
    assert reader.feed(frames)[-1].get_seq() == 19


@given(st.integers(1, 30))
def test_frames_may_come_in_pieces_of_any_size(size: int) -> None:
    codec, reader = Codec(7, 1), Codec(255, 190)
    data = b"".join(codec.pack(heartbeat()) for _ in range(5))
    pieces = [data[start : start + size] for start in range(0, len(data), size)]
    assert sum(len(reader.feed(piece)) for piece in pieces) == 5
    assert reader.skipped_bytes == 0


def test_a_flipped_bit_costs_that_frame_only() -> None:
    codec, reader = Codec(7, 1), Codec(255, 190)
    frames = [bytearray(codec.pack(heartbeat())) for _ in range(3)]
    frames[1][12] ^= 0x10
    assert [message.get_seq() for message in reader.feed(b"".join(frames))] == [0, 2]


def test_sequence_numbers_wrap_at_256() -> None:
    codec = Codec(7, 1)
    assert [codec.pack(heartbeat())[4] for _ in range(258)][-3:] == [255, 0, 1]


def test_frames_of_version_1_are_read() -> None:
    frame = heartbeat().pack(mavlink.MAVLink(None, 3, 1), force_mavlink1=True)
    assert Codec(255, 190).feed(frame)[0].get_srcSystem() == 3


def test_signed_frames_are_read_as_others_are() -> None:
    codec, reader = Codec(7, 1), Codec(255, 190)
    data = b"".join(codec.pack(heartbeat(), Signing(key=bytes(range(32)))) for _ in range(3)) + codec.pack(heartbeat())
    assert [message.get_seq() for message in reader.feed(data)] == [0, 1, 2, 3]


def test_what_is_not_read_is_counted_once_a_gap() -> None:
    codec, reader = Codec(7, 1), Codec(255, 190)
    damaged, foreign = bytearray(codec.pack(heartbeat())), bytearray(codec.pack(heartbeat()))
    damaged[12] ^= 0xFD ^ damaged[12]  # looks like one more start
    foreign[7:10] = (0x00, 0xFF, 0xFF)
    for garbage in (damaged, foreign, foreign):
        reader.feed(bytes(garbage) + codec.pack(heartbeat()))
    assert (reader.damaged, reader.unknown) == (1, 2)
    assert reader.skipped_bytes == len(damaged) + 2 * len(foreign)


@given(st.lists(st.binary(max_size=300), max_size=30))
def test_its_memory_is_bounded_by_one_frame(pieces: list[bytes]) -> None:
    reader = Codec(255, 190)
    for piece in pieces:
        reader.feed(piece)
        assert len(reader._rest) < 12 + 255 + 13


@settings(max_examples=400)
@given(st.data())
def test_every_message_is_packed_to_the_bytes_of_pymavlink(data: Any) -> None:
    kind = data.draw(st.sampled_from(sorted(mavlink.mavlink_map.values(), key=lambda one: one.id)))
    payload = data.draw(st.binary(min_size=kind.unpacker.size, max_size=kind.unpacker.size) | st.just(bytes(260)))
    read, theirs = mavlink.MAVLink(None), mavlink.MAVLink(None, srcSystem=7, srcComponent=1)
    seq = data.draw(st.integers(0, 3))
    message = read.decode(bytearray(in_a_frame(kind, payload[: kind.unpacker.size])))
    ours = Codec(7, 1)
    for theirs.seq in range(seq):
        ours.pack(heartbeat())
    theirs.seq = seq
    assert ours.pack(message) == bytes(message.pack(theirs))


def in_a_frame(kind: Any, payload: bytes) -> bytes:
    body = bytes([len(payload), 0, 0, 0, 1, 1]) + kind.id.to_bytes(3, "little") + payload
    return b"\xfd" + body + mcrf4xx(body + bytes([kind.crc_extra])).to_bytes(2, "little")
