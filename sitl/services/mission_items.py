"""One mission item on the wire: MISSION_ITEM_INT to MissionItem and back, refusing what cannot be stored."""

import math

from pymavlink.dialects.v20 import ardupilotmega as mavlink

from missions.commands import Command, Frame
from missions.mission import MissionItem, degrees_to_e7
from sitl.services.peer import Message

_POSITION_FRAMES = frozenset({Frame.GLOBAL, Frame.GLOBAL_RELATIVE_ALT, Frame.GLOBAL_INT, Frame.GLOBAL_RELATIVE_ALT_INT})
_POSITION_COMMANDS = frozenset({Command.NAV_WAYPOINT, Command.NAV_LOITER_UNLIM, Command.NAV_TAKEOFF})
_COMMANDS = _POSITION_COMMANDS | {Command.DO_CHANGE_SPEED}

_LARGEST_ALTITUDE_M = 83_000.0
"""ArduPilot's LOCATION_ALT_MAX_M."""


def item_message(item: MissionItem, seq: int, target_system: int, target_component: int) -> Message:
    """`item` as MISSION_ITEM_INT; item 1 is marked as the current one, as stations and MAVSDK expect of one item."""
    return mavlink.MAVLink_mission_item_int_message(
        target_system,
        target_component,
        seq,
        item.frame,
        item.command,
        int(seq == 1),
        int(item.autocontinue),
        *item.params,
        item.lat_e7,
        item.lon_e7,
        item.alt_m,
        mavlink.MAV_MISSION_TYPE_MISSION,
    )


def decode_item(message: Message) -> MissionItem:
    """The item in a MISSION_ITEM_INT or MISSION_ITEM, unchecked; the position of the latter must be finite."""
    degrees = message.get_type() == "MISSION_ITEM"
    return MissionItem(
        command=message.command,
        frame=message.frame,
        param1=message.param1,
        param2=message.param2,
        param3=message.param3,
        param4=message.param4,
        lat_e7=degrees_to_e7(message.x) if degrees else message.x,
        lon_e7=degrees_to_e7(message.y) if degrees else message.y,
        alt_m=message.z,
        autocontinue=bool(message.autocontinue),
    )


def check_item(message: Message) -> MissionItem | int:
    """The item in a MISSION_ITEM_INT or MISSION_ITEM, or the MAV_MISSION_RESULT that says why it is refused."""
    if not (math.isfinite(message.x) and math.isfinite(message.y)):
        return int(
            mavlink.MAV_MISSION_INVALID_PARAM6_Y if math.isfinite(message.x) else mavlink.MAV_MISSION_INVALID_PARAM5_X
        )
    item = decode_item(message)
    if item.command not in _COMMANDS:
        return int(mavlink.MAV_MISSION_UNSUPPORTED)
    positional = item.command in _POSITION_COMMANDS
    if item.frame not in _POSITION_FRAMES and (positional or item.frame != Frame.MISSION):
        return int(mavlink.MAV_MISSION_UNSUPPORTED_FRAME)
    return _invalid_field(item) or item


def _invalid_field(item: MissionItem) -> int:
    """The INVALID_PARAMn of the first field that cannot be stored, 0 when there is none."""
    first_param = int(mavlink.MAV_MISSION_INVALID_PARAM1)
    for index, value in enumerate(item.params[:3]):
        if not math.isfinite(value):
            return first_param + index
    if math.isinf(item.param4):  # NaN is the default heading
        return int(mavlink.MAV_MISSION_INVALID_PARAM4)
    if abs(item.lat_e7) > 90 * 10**7:
        return int(mavlink.MAV_MISSION_INVALID_PARAM5_X)
    if abs(item.lon_e7) > 180 * 10**7:
        return int(mavlink.MAV_MISSION_INVALID_PARAM6_Y)
    if not abs(item.alt_m) <= _LARGEST_ALTITUDE_M:  # NaN included
        return int(mavlink.MAV_MISSION_INVALID_PARAM7)
    return 0
