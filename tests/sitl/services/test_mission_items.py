"""What is true of one mission item on the wire."""

import math
from typing import Any

import pytest
from pymavlink.dialects.v20 import ardupilotmega as mavlink

from missions.mission import MissionItem
from sitl.services.codec import Codec
from sitl.services.mission_items import check_item, decode_item, item_message


def over_the_wire(message: Any) -> Any:
    return Codec(255, 190).feed(Codec(1, 1).pack(message))[0]


def test_an_item_crosses_the_wire_unchanged(make_mission: Any) -> None:
    for seq, item in enumerate(make_mission(12)):
        message = over_the_wire(item_message(item, seq, 1, 1))
        assert (message.seq, decode_item(message), check_item(message)) == (seq, item, item)


def test_the_old_float_message_is_read_to_the_nearest_of_what_it_can_hold() -> None:
    message = over_the_wire(
        mavlink.MAVLink_mission_item_message(1, 1, 2, 3, 16, 0, 1, 0, 0, 0, 0, 46.5, -11.25, 300.0, 0)
    )
    assert check_item(message) == MissionItem(16, 3, lat_e7=465_000_000, lon_e7=-112_500_000, alt_m=300.0)


def test_frames_5_and_6_become_0_and_3() -> None:
    wire = mavlink.MAVLink_mission_item_int_message(1, 1, 2, 6, 16, 0, 1, 0, 0, 0, math.nan, 1, 2, 3.0, 0)
    item = check_item(over_the_wire(wire))
    assert isinstance(item, MissionItem)
    assert (item.frame, math.isnan(item.param4)) == (3, True)


NAN = math.nan


@pytest.mark.parametrize(
    ("changes", "result"),
    [
        ({"command": 5001}, mavlink.MAV_MISSION_UNSUPPORTED),
        ({"frame": 1}, mavlink.MAV_MISSION_UNSUPPORTED_FRAME),
        ({"frame": 2}, mavlink.MAV_MISSION_UNSUPPORTED_FRAME),
        ({"frame": 10}, mavlink.MAV_MISSION_UNSUPPORTED_FRAME),
        ({"param1": NAN}, mavlink.MAV_MISSION_INVALID_PARAM1),
        ({"param2": NAN}, mavlink.MAV_MISSION_INVALID_PARAM2),
        ({"param3": math.inf}, mavlink.MAV_MISSION_INVALID_PARAM3),
        ({"param4": math.inf}, mavlink.MAV_MISSION_INVALID_PARAM4),
        ({"x": 95 * 10**7}, mavlink.MAV_MISSION_INVALID_PARAM5_X),
        ({"y": -181 * 10**7}, mavlink.MAV_MISSION_INVALID_PARAM6_Y),
        ({"z": NAN}, mavlink.MAV_MISSION_INVALID_PARAM7),
        ({"z": 1e7}, mavlink.MAV_MISSION_INVALID_PARAM7),
    ],
)
def test_what_cannot_be_stored_is_refused_by_its_cause(changes: dict[str, Any], result: int) -> None:
    fields = {"frame": 0, "command": 16, "param1": 0, "param2": 0, "param3": 0, "param4": 0, "x": 1, "y": 2, "z": 3.0}
    message = mavlink.MAVLink_mission_item_int_message(1, 1, 2, current=0, autocontinue=1, **(fields | changes))
    assert check_item(over_the_wire(message)) == result


@pytest.mark.parametrize(("x", "y", "result"), [(NAN, 1.0, 10), (1.0, NAN, 11), (95.0, 1.0, 10), (1e30, 1.0, 10)])
def test_float_coordinates_that_are_none_are_refused(x: float, y: float, result: int) -> None:
    message = mavlink.MAVLink_mission_item_message(1, 1, 2, 0, 16, 0, 1, 0, 0, 0, 0, x, y, 3.0, 0)
    assert check_item(over_the_wire(message)) == result
