"""The opaque plan id of the MAVLink mission protocol: which plan is this?, without downloading it.

MISSION_ACK, MISSION_COUNT and MISSION_CURRENT carry it in extension fields that pymavlink's generated dialect does not
have yet. An extension leaves the message's checksum seed alone, so these three subclasses only append to the payload;
a reader that does not know the fields skips them.
"""

import struct
import zlib

from pymavlink.dialects.v20 import ardupilotmega as mavlink

from missions.mission import Mission
from sitl.services.peer import Message

_ACK = struct.Struct("<BBBBI")
_COUNT = struct.Struct("<HBBBI")
_CURRENT = struct.Struct("<HHBBIII")
_ITEM = struct.Struct("<HB?4fiif")
_HEADER_V2 = 10


def opaque_id(mission: Mission) -> int:
    """CRC-32 of the items after home; 0 for a mission that has none."""
    crc = 0
    for item in mission.items[1:]:
        fields = (item.command, item.frame, item.autocontinue, *item.params, item.lat_e7, item.lon_e7, item.alt_m)
        crc = zlib.crc32(_ITEM.pack(*fields), crc)
    return crc or int(len(mission) > 1)


class MissionAck(mavlink.MAVLink_mission_ack_message):  # type: ignore[misc]
    """MISSION_ACK with opaque_id."""

    def __init__(self, target_system: int, target_component: int, result: int, mission_type: int, plan_id: int) -> None:
        super().__init__(target_system, target_component, result, mission_type)
        self.opaque_id = plan_id

    def pack(self, mav: Message, force_mavlink1: bool = False) -> bytes:
        """The frame, extension included."""
        payload = _ACK.pack(self.target_system, self.target_component, self.type, self.mission_type, self.opaque_id)
        return bytes(self._pack(mav, self.crc_extra, payload, force_mavlink1))


class MissionCount(mavlink.MAVLink_mission_count_message):  # type: ignore[misc]
    """MISSION_COUNT with opaque_id."""

    def __init__(self, target_system: int, target_component: int, count: int, mission_type: int, plan_id: int) -> None:
        super().__init__(target_system, target_component, count, mission_type)
        self.opaque_id = plan_id

    def pack(self, mav: Message, force_mavlink1: bool = False) -> bytes:
        """The frame, extension included."""
        payload = _COUNT.pack(self.count, self.target_system, self.target_component, self.mission_type, self.opaque_id)
        return bytes(self._pack(mav, self.crc_extra, payload, force_mavlink1))


class MissionCurrent(mavlink.MAVLink_mission_current_message):  # type: ignore[misc]
    """MISSION_CURRENT with mission_id; there are no fences and no rally points, so their ids are 0."""

    def __init__(self, seq: int, total: int, mission_state: int, mission_mode: int, plan_id: int) -> None:
        super().__init__(seq, total, mission_state, mission_mode)
        self.opaque_id = plan_id

    def pack(self, mav: Message, force_mavlink1: bool = False) -> bytes:
        """The frame, extensions included."""
        payload = _CURRENT.pack(self.seq, self.total, self.mission_state, self.mission_mode, self.opaque_id, 0, 0)
        return bytes(self._pack(mav, self.crc_extra, payload, force_mavlink1))


_LAYOUTS = {
    mavlink.MAVLINK_MSG_ID_MISSION_ACK: (_ACK, 4),
    mavlink.MAVLINK_MSG_ID_MISSION_COUNT: (_COUNT, 4),
    mavlink.MAVLINK_MSG_ID_MISSION_CURRENT: (_CURRENT, 4),
}


def received_opaque_id(message: Message) -> int:
    """The id in a received MISSION_ACK, MISSION_COUNT or MISSION_CURRENT; 0 when its sender gives none."""
    layout, index = _LAYOUTS[message.get_msgId()]
    frame = message.get_msgbuf()
    if frame[0] != 0xFD:
        return 0
    payload = bytes(frame[_HEADER_V2 : _HEADER_V2 + frame[1]])
    return int(layout.unpack(payload[: layout.size].ljust(layout.size, b"\0"))[index])
