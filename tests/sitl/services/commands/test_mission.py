"""Starting the mission, and going on with another item of it."""

import math
from typing import Any

import pytest
from pymavlink.dialects.v20 import ardupilotmega as mavlink

from sitl.modes import Mode


def test_the_mission_is_started_whole_or_not_at_all(bench: Any) -> None:
    assert bench.command(300)[0] == mavlink.MAV_RESULT_ACCEPTED
    assert bench.vehicle.state.mode == Mode.AUTO
    assert bench.command(300, 2, 3)[0] == mavlink.MAV_RESULT_DENIED


def test_it_goes_on_with_any_item_there_is(bench: Any) -> None:
    assert bench.command(224, 4)[0] == mavlink.MAV_RESULT_ACCEPTED
    assert bench.vehicle.asked[-1] == ("set_current", 4)
    bench.vehicle.refusal = "not now"
    assert bench.refused(224, 2) == (mavlink.MAV_RESULT_FAILED, "not now")


@pytest.mark.parametrize("seq", [5, -1, 1.5, math.nan, math.inf, 1e9])
def test_items_that_are_not_there_are_denied(bench: Any, seq: float) -> None:
    assert bench.command(224, seq)[0] == mavlink.MAV_RESULT_DENIED
    assert bench.vehicle.asked == []


def test_the_old_message_is_silent_out_of_range(bench: Any) -> None:
    assert bench.tell(mavlink.MAVLink_mission_set_current_message(3, 1, 5)) == []
    assert bench.vehicle.asked == []
    assert bench.tell(mavlink.MAVLink_mission_set_current_message(3, 1, 2)) == []
    assert bench.vehicle.asked == [("set_current", 2)]
