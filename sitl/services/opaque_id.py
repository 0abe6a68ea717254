"""The opaque plan id of the MAVLink mission protocol: which plan is this?, without downloading it.

MISSION_ACK, MISSION_COUNT and MISSION_CURRENT carry it in extension fields that pymavlink's generated dialect does not
have yet. An extension leaves the message's checksum seed alone, so these three subclasses only append to the payload;
a reader that does not know the fields skips them.
"""

import struct
import zlib
from collections.abc import Iterable
from itertools import islice

from pymavlink.dialects.v20 import ardupilotmega as mavlink

from missions.mission import MissionItem
from missions.plan_type import PlanType
from sitl.services.peer import Message

_ACK = struct.Struct("<BBBBI")
_COUNT = struct.Struct("<HBBBI")
_CURRENT = struct.Struct("<HHBBIII")
_ITEM = struct.Struct("<HB?4fiif")
_MAGIC_V2 = 0xFD
_HEADER_V2 = 10


def opaque_id(plan: PlanType, items: Iterable[MissionItem]) -> int:
    """CRC-32 of a plan's items, home left out; 0 for a plan that has none."""
    crc = count = 0
    for item in islice(items, int(plan == PlanType.MISSION), None):
        fields = (item.command, item.frame, item.autocontinue, *item.params, item.lat_e7, item.lon_e7, item.alt_m)
        crc = zlib.crc32(_ITEM.pack(*fields), crc)
        count += 1
    return crc or int(count > 0)


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
    """MISSION_CURRENT with mission_id, fence_id and rally_points_id."""

    def __init__(
        self, seq: int, total: int, mission_state: int, mission_mode: int, plan_ids: tuple[int, int, int]
    ) -> None:
        super().__init__(seq, total, mission_state, mission_mode)
        self.opaque_ids = plan_ids

    def pack(self, mav: Message, force_mavlink1: bool = False) -> bytes:
        """The frame, extensions included."""
        payload = _CURRENT.pack(self.seq, self.total, self.mission_state, self.mission_mode, *self.opaque_ids)
        return bytes(self._pack(mav, self.crc_extra, payload, force_mavlink1))


def received_opaque_id(message: Message) -> int:
    """The id in a received MISSION_ACK or MISSION_COUNT; 0 when its sender gives none."""
    return int(_received(message, _ACK if message.get_type() == "MISSION_ACK" else _COUNT)[-1])


def received_opaque_ids(message: Message) -> tuple[int, int, int]:
    """The ids of mission, fence and rally points in a received MISSION_CURRENT; 0 for what its sender does not give."""
    mission_id, fence_id, rally_id = _received(message, _CURRENT)[-3:]
    return int(mission_id), int(fence_id), int(rally_id)


def _received(message: Message, layout: struct.Struct) -> tuple[int, ...]:
    frame = message.get_msgbuf()
    payload = bytes(frame[_HEADER_V2 : _HEADER_V2 + frame[1]]) if frame[0] == _MAGIC_V2 else b""
    return layout.unpack(payload[: layout.size].ljust(layout.size, b"\0"))
