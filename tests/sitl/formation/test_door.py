"""What is let in of a neighbour: its samples, in order; all else is counted by reason, and told once."""

import struct

import pytest
from hypothesis import given
from hypothesis import strategies as st

from sitl.formation.correction import Correction, decode, encode
from sitl.formation.door import Door

NEIGHBOUR, LAST, LATEST = 2, 100, 1000


def sample(tick: int, sysid: int = NEIGHBOUR, sequence: int | None = None) -> Correction:
    return Correction(sysid, tick, tick if sequence is None else sequence, True, 0.5, -0.5)


def changed(offset: int, form: str, value: object) -> bytes:
    payload = bytearray(encode(sample(LAST + 1)))
    struct.pack_into(form, payload, offset, value)
    return bytes(payload)


REFUSED = {
    "length no multiple of 72 bytes": encode(sample(LAST + 1))[:-1],
    "not a correction": changed(0, "2s", b"XX"),
    "not of version 2": changed(2, "B", 1),
    "not finite": changed(24, "<d", float("nan")),
    "another's system id": encode(sample(LAST + 1, sysid=9)),
    "time goes backwards": encode(sample(LAST - 1)),
    "far in the future": encode(sample(LATEST + 1)),
    "sequence out of step with time": encode(sample(LAST + 1, sequence=2**60)),
    "sequence goes backwards": encode(sample(LAST + 1)) + encode(sample(LAST + 2, sequence=LAST)),
}


@pytest.fixture
def door() -> Door:
    """One that has let in a sample of tick LAST."""
    door = Door(NEIGHBOUR, decode, "Corrections")
    assert door.admit(encode(sample(LAST)), LATEST) == [sample(LAST)]
    return door


@pytest.mark.parametrize("reason", REFUSED)
def test_each_kind_of_nonsense_is_refused_counted_and_told_once(door: Door, reason: str) -> None:
    for _ in range(3):
        assert door.admit(REFUSED[reason], LATEST) == []
    assert door.refused == {reason: 3}
    assert door.complaints() == [f"Corrections of {NEIGHBOUR} refused: {reason}"]
    assert door.complaints() == []
    assert door.admit(encode(sample(LAST + 1)), LATEST) == [sample(LAST + 1)], "and changes nothing"


@given(st.lists(st.integers(1, 5), min_size=1, max_size=20), st.data())
def test_samples_in_order_are_all_let_in_however_they_share_messages(steps: list[int], data: st.DataObject) -> None:
    door, tick, sent, got = Door(NEIGHBOUR, decode, "Corrections"), 0, [], []
    while steps:
        count = data.draw(st.integers(1, len(steps)))
        batch = []
        for step in steps[:count]:
            tick += step
            batch.append(sample(tick))
        steps = steps[count:]
        sent += batch
        got += door.admit(b"".join(map(encode, batch)), LATEST)
    assert got == sent
    assert not door.refused


def test_the_newest_may_come_twice() -> None:
    door = Door(NEIGHBOUR, decode, "Corrections")
    assert door.admit(encode(sample(5)), LATEST) == door.admit(encode(sample(5)), LATEST) == [sample(5)]


def test_who_has_come_back_may_begin_anew(door: Door) -> None:
    door.reopen()
    assert door.admit(encode(sample(3)), LATEST) == [sample(3)]
