"""What is true of one item of a plan on the wire."""

import math
from typing import Any

import pytest
from pymavlink.dialects.v20 import ardupilotmega as mavlink

from missions.mission import MissionItem
from missions.plan_type import PlanType
from sitl.services.codec import Codec
from sitl.services.item_rules import Refusal
from sitl.services.mission_items import check_item, decode_item, item_message

MISSION, FENCE, RALLY = PlanType.MISSION, PlanType.FENCE, PlanType.RALLY
NAN = math.nan


def over_the_wire(message: Any) -> Any:
    return Codec(255, 190).feed(Codec(1, 1).pack(message))[0]


def judged(plan: PlanType, count: int = 20, **changes: Any) -> int:
    """The result of an item like a harmless waypoint but for some changes; 0 for one that is taken."""
    fields = {"frame": 0, "command": 16, "param1": 0, "param2": 0, "param3": 0, "param4": 0, "x": 1, "y": 2, "z": 3.0}
    message = mavlink.MAVLink_mission_item_int_message(
        1, 1, 2, current=0, autocontinue=1, mission_type=plan, **(fields | changes)
    )
    item = check_item(over_the_wire(message), plan, count)
    if isinstance(item, Refusal):
        assert item.reason
        return item.result
    return 0


def test_an_item_crosses_the_wire_unchanged(make_mission: Any) -> None:
    for seq, item in enumerate(make_mission(12)):
        message = over_the_wire(item_message(item, seq, 1, 1))
        assert (message.seq, decode_item(message), check_item(message, MISSION, 12)) == (seq, item, item)


def test_one_item_is_marked_as_the_first_to_be_flown(make_mission: Any) -> None:
    def marked(**home_first: bool) -> list[int]:
        messages = [item_message(item, seq, 1, 1, MISSION, **home_first) for seq, item in enumerate(make_mission(5))]
        return [message.seq for message in messages if message.current]

    assert marked() == [1]
    assert marked(home_first=False) == [0]


def test_the_old_float_message_is_read_to_the_nearest_of_what_it_can_hold() -> None:
    message = over_the_wire(
        mavlink.MAVLink_mission_item_message(1, 1, 2, 3, 16, 0, 1, 0, 0, 0, 0, 46.5, -11.25, 300.0, 0)
    )
    assert check_item(message, MISSION, 20) == MissionItem(16, 3, lat_e7=465_000_000, lon_e7=-112_500_000, alt_m=300.0)


def test_frames_5_and_6_become_0_and_3() -> None:
    wire = mavlink.MAVLink_mission_item_int_message(1, 1, 2, 6, 16, 0, 1, 0, 0, 0, math.nan, 1, 2, 3.0, 0)
    item = check_item(over_the_wire(wire), MISSION, 20)
    assert isinstance(item, MissionItem)
    assert (item.frame, math.isnan(item.param4)) == (3, True)


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
    assert judged(MISSION, **changes) == result


@pytest.mark.parametrize(
    ("command", "fields"),
    [
        (16, {}),
        (17, {"param1": NAN, "param2": NAN, "param3": -80.0}),
        (18, {"param1": 2.0, "param3": 80.0}),
        (19, {"param1": 30.0, "param3": -80.0, "x": 0, "y": 0}),
        (20, {"frame": 2, "param1": NAN, "z": NAN}),
        (21, {"param4": NAN}),
        (22, {"param1": 15.0, "param4": NAN, "x": 0, "y": 0}),
        (31, {"param1": 1.0, "param2": 80.0}),
        (177, {"frame": 2, "param1": 19.0, "param2": -1.0, "x": 2**31 - 1}),
        (178, {"frame": 2, "param1": 1.0, "param2": -2.0, "param3": -1.0}),
        (189, {"frame": 2}),
        (189, {"frame": 3}),
    ],
)
def test_each_command_of_a_mission_is_taken(command: int, fields: dict[str, Any]) -> None:
    assert judged(MISSION, command=command, **fields) == 0


@pytest.mark.parametrize(
    ("command", "fields", "result"),
    [
        (16, {"param1": -1.0}, mavlink.MAV_MISSION_INVALID_PARAM1),
        (18, {"param1": 0.0}, mavlink.MAV_MISSION_INVALID_PARAM1),
        (19, {"param1": NAN}, mavlink.MAV_MISSION_INVALID_PARAM1),
        (31, {"param2": NAN}, mavlink.MAV_MISSION_INVALID_PARAM2),
        (177, {"param1": 0.0}, mavlink.MAV_MISSION_INVALID_PARAM1),
        (177, {"param1": 20.0}, mavlink.MAV_MISSION_INVALID_PARAM1),
        (177, {"param1": 1.5}, mavlink.MAV_MISSION_INVALID_PARAM1),
        (177, {"param1": NAN}, mavlink.MAV_MISSION_INVALID_PARAM1),
        (177, {"param1": 1.0, "param2": -2.0}, mavlink.MAV_MISSION_INVALID_PARAM2),
        (177, {"param1": 1.0, "param2": NAN}, mavlink.MAV_MISSION_INVALID_PARAM2),
        (178, {"param1": 2.0, "param2": 20.0}, mavlink.MAV_MISSION_INVALID_PARAM1),
        (178, {"param2": 0.0}, mavlink.MAV_MISSION_INVALID_PARAM2),
        (178, {"param2": 20.0, "param3": NAN}, mavlink.MAV_MISSION_INVALID_PARAM3),
        (178, {"param2": 20.0, "frame": 10}, mavlink.MAV_MISSION_UNSUPPORTED_FRAME),
        (84, {}, mavlink.MAV_MISSION_UNSUPPORTED),
        (5100, {}, mavlink.MAV_MISSION_UNSUPPORTED),
        (65535, {}, mavlink.MAV_MISSION_UNSUPPORTED),
    ],
)
def test_what_a_mission_cannot_fly_is_refused_by_its_cause(command: int, fields: dict[str, Any], result: int) -> None:
    assert judged(MISSION, command=command, **fields) == result


def test_items_belong_to_plans_of_their_own_type() -> None:
    fence, rally = (5000, 5001, 5002, 5003, 5004), (5100,)
    for command in (*fence, *rally, 16):
        assert (judged(FENCE, command=command) == 0) == (command in fence)
        assert (judged(RALLY, command=command) == 0) == (command in rally)
    assert judged(FENCE, command=5003, frame=10) == mavlink.MAV_MISSION_UNSUPPORTED_FRAME
    assert judged(FENCE, command=5001, x=91 * 10**7) == mavlink.MAV_MISSION_INVALID_PARAM5_X
    assert judged(RALLY, command=5100, frame=11) == mavlink.MAV_MISSION_UNSUPPORTED_FRAME
    assert judged(RALLY, command=5100, z=NAN) == mavlink.MAV_MISSION_INVALID_PARAM7


@pytest.mark.parametrize(("x", "y", "result"), [(NAN, 1.0, 10), (1.0, NAN, 11), (95.0, 1.0, 10), (1e30, 1.0, 10)])
def test_float_coordinates_that_are_none_are_refused(x: float, y: float, result: int) -> None:
    message = mavlink.MAVLink_mission_item_message(1, 1, 2, 0, 16, 0, 1, 0, 0, 0, 0, x, y, 3.0, 0)
    item = check_item(over_the_wire(message), MISSION, 20)
    assert isinstance(item, Refusal)
    assert item.result == result


@pytest.mark.parametrize("x", [NAN, math.inf, 1e30, 5.0])
def test_the_position_of_a_command_without_one_does_no_harm(x: float) -> None:
    message = mavlink.MAVLink_mission_item_message(1, 1, 2, 2, 178, 0, 1, 0, 20.0, -1.0, 0, x, x, x, 0)
    item = check_item(over_the_wire(message), MISSION, 20)
    assert isinstance(item, MissionItem)
    assert check_item(over_the_wire(item_message(item, 2, 1, 1)), MISSION, 20) is not None
