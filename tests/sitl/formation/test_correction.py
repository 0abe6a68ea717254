"""Corrections on the wire: read back equal, and anything else refused."""

import struct

import pytest
from hypothesis import given
from hypothesis import strategies as st

from sitl.formation.correction import Correction, decode, encode

finite = st.floats(allow_nan=False, allow_infinity=False)
samples = st.builds(
    Correction,
    st.integers(0, 2**32 - 1),
    st.integers(-(2**63), 2**63 - 1),
    st.integers(0, 2**64 - 1),
    st.booleans(),
    finite,
    finite,
    finite,
    finite,
    finite,
    finite,
)
SAMPLE = Correction(3, 100, 100, True, 1.5, -0.5)


@given(st.lists(samples, min_size=1, max_size=5))
def test_what_is_sent_is_what_is_heard(sent: list[Correction]) -> None:
    assert decode(b"".join(encode(sample) for sample in sent)) == sent


@given(st.binary(max_size=80))
def test_other_payloads_are_refused_not_believed(payload: bytes) -> None:
    try:
        heard = decode(payload)
    except ValueError:
        return
    assert encode(heard[0])[:3] == payload[:3]


@pytest.mark.parametrize("offset", range(24, 72, 8))
@pytest.mark.parametrize("value", [float("nan"), float("inf")])
def test_numbers_that_are_none_are_refused(offset: int, value: float) -> None:
    payload = bytearray(encode(SAMPLE))
    struct.pack_into("<d", payload, offset, value)
    with pytest.raises(ValueError, match="finite"):
        decode(bytes(payload))


def test_another_version_is_refused() -> None:
    payload = bytearray(encode(SAMPLE))
    payload[2] = 1
    with pytest.raises(ValueError, match="version 2"):
        decode(bytes(payload))
