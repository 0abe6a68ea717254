"""Downloading a mission: the station's side of the MAVLink mission protocol."""

from collections.abc import Callable

from pymavlink.dialects.v20 import ardupilotmega as mavlink

from gcs.transfers.errors import TransferError
from gcs.transfers.transfer import Transfer
from missions.mission import Mission, MissionItem
from sitl.services.mission_items import decode_item
from sitl.services.peer import Message

_MISSION = mavlink.MAV_MISSION_TYPE_MISSION


class MissionDownload(Transfer[Mission]):
    """Pulls the mission that one vehicle holds, item by item.

    Args:
        sysid, compid, send, now: as of Transfer.
    """

    def __init__(self, sysid: int, compid: int, send: Callable[[Message], None], now: Callable[[], float]) -> None:
        super().__init__(sysid, compid, send, now)
        self._count: int | None = None
        self._items: list[MissionItem] = []

    def start(self) -> None:
        """Ask for the list with MISSION_REQUEST_LIST."""
        self._ask(mavlink.MAVLink_mission_request_list_message(*self._target, _MISSION))

    def _take(self, message: Message) -> None:
        kind = message.get_type()
        if not kind.startswith("MISSION_") or getattr(message, "mission_type", None) != _MISSION:
            return
        if kind == "MISSION_COUNT" and self._count is None:
            self._answered(message)
            self._count = message.count
            self._go_on()
        elif kind == "MISSION_ITEM_INT" and self._count is not None and message.seq == len(self._items):
            self._answered(message)
            self._items.append(decode_item(message))
            self._go_on()
        elif kind == "MISSION_ACK" and message.type != mavlink.MAV_MISSION_ACCEPTED:
            self._heard(message)
            result = mavlink.enums["MAV_MISSION_RESULT"].get(message.type)
            name = result.name if result is not None else f"result {message.type}"
            self.outcome = self._error(f"download refused at {self._where()} with {name}")

    def _go_on(self) -> None:
        """Ask for the next item, or thank for the last."""
        if len(self._items) == self._count:
            self._send(mavlink.MAVLink_mission_ack_message(*self._target, mavlink.MAV_MISSION_ACCEPTED, _MISSION))
            self.outcome = Mission(tuple(self._items))
        else:
            self._ask(mavlink.MAVLink_mission_request_int_message(*self._target, len(self._items), _MISSION))

    def _give_up(self) -> "Mission | TransferError":
        return self._error(f"mission download stopped at {self._where()}: no answer; check the link and try again")

    def _where(self) -> str:
        return "MISSION_REQUEST_LIST" if self._count is None else f"item {len(self._items)} of {self._count}"
