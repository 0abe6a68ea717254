"""Uploading a mission: the station's side of the MAVLink mission protocol."""

from collections.abc import Callable
from dataclasses import dataclass

from pymavlink.dialects.v20 import ardupilotmega as mavlink

from gcs.transfers.errors import TransferError
from gcs.transfers.transfer import Transfer
from missions.mission import Mission
from sitl.services.mission_items import item_message
from sitl.services.peer import Message
from sitl.services.round_trip import INITIAL_S

_MISSION = mavlink.MAV_MISSION_TYPE_MISSION


@dataclass(frozen=True)
class Uploaded:
    """All items are out.

    Attributes:
        confirmed: the vehicle has said so; when False the last MISSION_ACK never came, and only reading back can tell.
    """

    confirmed: bool


class MissionUpload(Transfer[Uploaded]):
    """Sends one mission to one vehicle, which pulls the items in whatever order it likes.

    A repeated request is answered, but only a new one is progress. INVALID_SEQUENCE does not end an upload: ArduPilot
    sends it and goes on. When the last MISSION_ACK does not come, the last item is sent again.

    Args:
        mission: items in order, item 0 first.
        sysid, compid, send, now: as of Transfer.
    """

    def __init__(
        self, mission: Mission, sysid: int, compid: int, send: Callable[[Message], None], now: Callable[[], float]
    ) -> None:
        super().__init__(sysid, compid, send, now)
        self._mission = mission
        self._highest_seq = -1

    def start(self) -> None:
        """Announce the mission with MISSION_COUNT."""
        self._ask(mavlink.MAVLink_mission_count_message(*self._target, len(self._mission), _MISSION))

    def _take(self, message: Message) -> None:
        kind = message.get_type()
        if kind in ("MISSION_REQUEST_INT", "MISSION_REQUEST") and message.mission_type == _MISSION:
            self._take_request(message)
        elif kind == "MISSION_ACK" and message.mission_type == _MISSION:
            self._take_ack(message)

    def _take_request(self, message: Message) -> None:
        seq = message.seq
        if seq >= len(self._mission):
            return
        item = item_message(self._mission[seq], seq, *self._target)
        if seq <= self._highest_seq:
            self._heard(message)
            self._send(item)
            return
        self._answered(message)
        self._highest_seq = seq
        # In the middle the vehicle sets the pace (ArduPilot asks once a second); the last item wants its MISSION_ACK.
        self._ask(item, 0.0 if self._all_sent else INITIAL_S)

    def _take_ack(self, message: Message) -> None:
        self._heard(message)
        if message.type == mavlink.MAV_MISSION_INVALID_SEQUENCE:
            return
        if message.type != mavlink.MAV_MISSION_ACCEPTED:
            result = mavlink.enums["MAV_MISSION_RESULT"].get(message.type)
            name = result.name if result is not None else f"result {message.type}"
            self.outcome = self._error(f"mission refused at {self._where()} with {name}")
        elif self._all_sent or len(self._mission) == 0:
            self.outcome = Uploaded(confirmed=True)

    def _give_up(self) -> "Uploaded | TransferError":
        if self._all_sent:
            return Uploaded(confirmed=False)
        return self._error(
            f"mission upload stopped at {self._where()}: no further request; check the link and try again"
        )

    @property
    def _all_sent(self) -> bool:
        return self._highest_seq == len(self._mission) - 1

    def _where(self) -> str:
        if self._highest_seq < 0:
            return f"MISSION_COUNT {len(self._mission)}"
        return f"item {self._highest_seq} of {len(self._mission)}"
