"""Plans as bytes: every wire field comes back exactly, and damage is an error."""

from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from missions.errors import InputError
from missions.mission import MissionItem
from missions.plan_type import PlanType
from sitl.plan_memory import decode_plan, encode_plan, keep_plan, recall_plan
from sitl.store import Store

real = st.floats(width=32)
e7 = st.integers(-(2**31), 2**31 - 1)
items = st.builds(
    MissionItem, st.integers(0, 65535), st.integers(0, 255), real, real, real, real, e7, e7, real, st.booleans()
)


@given(st.lists(items, max_size=20))
def test_what_was_encoded_is_decoded(plan: list[MissionItem]) -> None:
    decoded = decode_plan(encode_plan(plan))
    assert repr(decoded) == repr(tuple(plan))  # as NaN is not equal to itself
    assert encode_plan(decoded) == encode_plan(plan)


@given(st.binary(max_size=80), st.integers(1, 30))
def test_other_bytes_are_no_plan(data: bytes, cut: int) -> None:
    with pytest.raises(InputError, match="no plan"):
        decode_plan(b"x" + data)
    with pytest.raises(InputError, match="no plan"):
        decode_plan(encode_plan([MissionItem(16)])[:-cut])


def test_each_type_is_a_piece_of_its_own(tmp_path: Path) -> None:
    store, item = Store(tmp_path), MissionItem(5100, lat_e7=1)
    keep_plan(store, PlanType.RALLY, [item])
    assert recall_plan(store, PlanType.RALLY) == (item,)
    assert recall_plan(store, PlanType.FENCE) is None
