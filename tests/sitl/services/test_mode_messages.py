"""The two messages that pymavlink's dialect has not."""

from hypothesis import given
from hypothesis import strategies as st

from sitl.services.codec import Codec
from sitl.services.mode_messages import AvailableModes, CurrentMode

byte, word = st.integers(0, 255), st.integers(0, 2**32 - 1)
name = st.text(st.characters(codec="ascii", exclude_characters="\0"), max_size=35)


@given(byte, byte, byte, word, word, name)
def test_available_modes_is_read_as_it_was_sent(
    n: int, i: int, standard: int, mode: int, flags: int, name: str
) -> None:
    sent = AvailableModes(n, i, standard, mode, flags, name.encode())
    (read,) = Codec(255, 190).feed(Codec(1, 1).pack(sent))
    assert [getattr(read, field) for field in sent.fieldnames] == [n, i, standard, mode, flags, name]


@given(byte, word, word)
def test_current_mode_is_read_as_it_was_sent(standard: int, mode: int, intended: int) -> None:
    sent = CurrentMode(standard, mode, intended)
    (read,) = Codec(255, 190).feed(Codec(1, 1).pack(sent))
    assert (read.standard_mode, read.custom_mode, read.intended_custom_mode) == (standard, mode, intended)
