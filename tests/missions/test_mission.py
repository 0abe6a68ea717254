"""Missions hold what the wire can carry, so that equal missions are equal on the wire."""

import math
import struct

from hypothesis import given
from hypothesis import strategies as st

from missions.commands import Command, Frame
from missions.mission import Mission, MissionItem, as_float32, degrees_to_e7


@given(st.floats(allow_nan=False, allow_infinity=False, width=32))
def test_a_float32_is_kept_as_it_is(value: float) -> None:
    assert as_float32(value) == value


@given(st.floats(-1e300, 1e300))
def test_parameters_are_what_the_wire_gives_back(value: float) -> None:
    item = MissionItem(Command.NAV_WAYPOINT, param1=value)
    if math.isfinite(item.param1):
        assert struct.unpack("<f", struct.pack("<f", item.param1))[0] == item.param1


def test_items_with_defaults_are_equal_though_nan_is_not() -> None:
    nan_again = float("nan")
    assert MissionItem(22, param4=math.nan) == MissionItem(22, param4=nan_again)


def test_the_int_frames_mean_the_plain_ones() -> None:
    assert MissionItem(16, 5).frame == Frame.GLOBAL
    assert MissionItem(16, 6).frame == Frame.GLOBAL_RELATIVE_ALT


def test_degrees_are_rounded_not_truncated() -> None:
    assert degrees_to_e7(46.99999999) == 470_000_000
    assert degrees_to_e7(-46.99999999) == -470_000_000


def test_home_is_replaced_and_the_rest_kept() -> None:
    mission = Mission((MissionItem(16), MissionItem(22), MissionItem(17)))
    home = MissionItem(16, lat_e7=5)
    assert mission.with_home(home).items == (home, *mission.items[1:])
