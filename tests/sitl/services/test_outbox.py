"""What is true of frames gathered into datagrams."""

from hypothesis import given
from hypothesis import strategies as st

from sitl.services.outbox import LARGEST_DATAGRAM_BYTES, Outbox


def test_what_is_put_leaves_together_and_once() -> None:
    sent: list[bytes] = []
    outbox = Outbox(sent.append)
    outbox.put(b"one")
    outbox.put(b"two")
    assert sent == []
    outbox.flush()
    outbox.flush()
    assert sent == [b"onetwo"]


@given(st.lists(st.binary(min_size=1, max_size=280)))
def test_every_frame_leaves_whole_and_in_order_in_datagrams_that_are_not_too_large(frames: list[bytes]) -> None:
    sent: list[bytes] = []
    outbox = Outbox(sent.append)
    for frame in frames:
        outbox.put(frame)
    outbox.flush()
    assert b"".join(sent) == b"".join(frames)
    assert all(len(data) <= LARGEST_DATAGRAM_BYTES for data in sent)
    ends = {len(b"".join(frames[:n])) for n in range(len(frames) + 1)}
    assert {len(b"".join(sent[:n])) for n in range(len(sent) + 1)} <= ends
