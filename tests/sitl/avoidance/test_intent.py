"""The message of an intent: its layout on the wire, and what is not let in."""

import math
import struct

import pytest
from hypothesis import given
from hypothesis import strategies as st

from sitl.avoidance.intent import (
    FARTHEST_M,
    KEEPS,
    PERIOD_TICKS,
    POINTS,
    QUIET,
    YIELDS,
    Intent,
    decode,
    encode,
    intent_at,
)
from sitl.formation.door import Door

OTHER, LATEST = 2, 100_000
metres = st.floats(-FARTHEST_M, FARTHEST_M)
intents = st.builds(
    lambda sysid, k, status, points, alone: intent_at(sysid, k * PERIOD_TICKS, status, tuple(points), alone),
    st.integers(1, 250),
    st.integers(0, 10_000),
    st.integers(QUIET, KEEPS),
    st.lists(st.tuples(metres, metres, metres), max_size=POINTS),
    st.floats(0.5, 1.5),
)


@given(intents)
def test_what_was_told_is_what_is_heard(intent: Intent) -> None:
    assert decode(encode(intent)) == [intent]


def test_the_layout_is_as_documented() -> None:
    message = encode(intent_at(7, 50, YIELDS, ((1.0, 2.0, 3.0), (4.0, 5.0, 6.0)), 0.75))
    assert message == b"SI\x01\x02" + struct.pack("<IqQd6d", 7, 50, 2, 0.75, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0)


def told(k: int, sysid: int = OTHER) -> Intent:
    return intent_at(sysid, k * PERIOD_TICKS, YIELDS, ((1.0, 2.0, 3.0),))


def changed(offset: int, form: str, value: object) -> bytes:
    payload = bytearray(encode(told(2)))
    struct.pack_into(form, payload, offset, value)
    return bytes(payload)


REFUSED = {
    "length not of at most 41 points": encode(told(2))[:-1],
    "not an intent": changed(0, "2s", b"SK"),
    "not of version 1": changed(2, "B", 2),
    "no such status": changed(3, "B", 4),
    "sequence out of step with time": changed(16, "<Q", 3),
    "no such pace": changed(24, "<d", math.nan),
    "not a place": changed(32, "<d", math.inf),
    "another's system id": encode(told(2, sysid=9)),
    "time goes backwards": encode(told(0)),
    "far in the future": encode(told(LATEST)),
}


@pytest.mark.parametrize("reason", REFUSED)
def test_each_kind_of_nonsense_is_refused_counted_and_told_once(reason: str) -> None:
    door = Door(OTHER, decode, "Intents")
    assert door.admit(encode(told(1)), LATEST) == [told(1)]
    for _ in range(3):
        assert door.admit(REFUSED[reason], LATEST) == []
    assert door.refused == {reason: 3}
    assert door.complaints() == [f"Intents of {OTHER} refused: {reason}"]
    assert door.admit(encode(told(2)), LATEST) == [told(2)], "and changes nothing"


@given(st.binary(max_size=1100))
def test_no_bytes_do_more_than_be_refused(payload: bytes) -> None:
    assert len(Door(OTHER, decode, "Intents").admit(payload, LATEST)) <= 1
