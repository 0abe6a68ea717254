"""One item of a plan on the wire: MISSION_ITEM_INT to MissionItem and back, refusing what cannot be stored."""

from pymavlink.dialects.v20 import ardupilotmega as mavlink

from missions.mission import MissionItem, degrees_to_e7
from missions.plan_type import PlanType
from sitl.services.item_rules import Refusal, command_name, invalid, is_place, refusal
from sitl.services.peer import Message

_LARGEST_DEG = 180.0


def item_message(
    item: MissionItem,
    seq: int,
    target_system: int,
    target_component: int,
    plan: PlanType = PlanType.MISSION,
    *,
    home_first: bool = True,
) -> Message:
    """`item` as MISSION_ITEM_INT.

    One item is marked as the current one, as MAVSDK demands of every plan: the first that is not home. PX4 begins its
    flight there.

    Args:
        item, seq: that is sent.
        target_system, target_component: to whom.
        plan: that it is of.
        home_first: whether item 0 of a mission is home.
    """
    return mavlink.MAVLink_mission_item_int_message(
        target_system,
        target_component,
        seq,
        item.frame,
        item.command,
        int(seq == (1 if plan == PlanType.MISSION and home_first else 0)),
        int(item.autocontinue),
        item.param1,
        item.param2,
        item.param3,
        item.param4,
        item.lat_e7,
        item.lon_e7,
        item.alt_m,
        int(plan),
    )


def decode_item(message: Message) -> MissionItem:
    """The item in a MISSION_ITEM_INT or MISSION_ITEM, unchecked; coordinates in degrees that are none are read as 0."""
    degrees = message.get_type() == "MISSION_ITEM"
    return MissionItem(
        command=message.command,
        frame=message.frame,
        param1=message.param1,
        param2=message.param2,
        param3=message.param3,
        param4=message.param4,
        lat_e7=_e7(message.x) if degrees else message.x,
        lon_e7=_e7(message.y) if degrees else message.y,
        alt_m=message.z,
        autocontinue=bool(message.autocontinue),
    )


def check_item(message: Message, plan: PlanType, count: int) -> MissionItem | Refusal:
    """The item in a MISSION_ITEM_INT or MISSION_ITEM of a plan of `count` items, or why it is refused."""
    item = decode_item(message)
    refused = refusal(item, plan, count)
    if refused is None and message.get_type() == "MISSION_ITEM" and is_place(item.command, plan):
        refused = _misplaced(message)
    return refused or item


def _misplaced(message: Message) -> Refusal | None:
    """What is wrong with a position in degrees."""
    if not abs(message.x) <= 90.0:
        return invalid(5, f"{command_name(message.command)} latitude {message.x:g}")
    if not abs(message.y) <= _LARGEST_DEG:
        return invalid(6, f"{command_name(message.command)} longitude {message.y:g}")
    return None


def _e7(angle_deg: float) -> int:
    return degrees_to_e7(angle_deg) if abs(angle_deg) <= _LARGEST_DEG else 0
