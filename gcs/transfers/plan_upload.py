"""Uploading a plan: the station's side of the MAVLink mission protocol."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass

from pymavlink.dialects.v20 import ardupilotmega as mavlink

from gcs.transfers.acquaintance import Acquaintance
from gcs.transfers.errors import TransferError
from gcs.transfers.plan_transfer import PlanTransfer
from missions.mission import MissionItem
from missions.plan_type import PlanType
from sitl.services.mission_items import item_message
from sitl.services.peer import Message

_LOST_S = 8.0
"""A vehicle that has asked for nothing for so long has given the upload up (ArduPilot after 8 s, PX4 after 5 s)."""

_UNCONFIRMED_S = 4.0
"""When all items are out and nothing has been heard for so long, reading back tells more than waiting."""


@dataclass(frozen=True)
class Uploaded:
    """All items are out.

    Attributes:
        confirmed: the vehicle has said so; when False the last MISSION_ACK never came, and only reading back can tell.
    """

    confirmed: bool


class PlanUpload(PlanTransfer[Uploaded]):
    """Sends one plan to one vehicle, which pulls the items in whatever order it likes, one by one or many at a time.

    Every request is answered, but only one for an item not asked for before is progress. INVALID_SEQUENCE does not end
    an upload: ArduPilot sends it and goes on. When nothing comes, the item asked for last is sent again, and the one
    after it, as it may be the request for that which was lost; after the last item, that one, until its MISSION_ACK.

    Args:
        plan_type: what the items are.
        items: in order.
        sysid, compid, send, now, known: as of Transfer.
        home_first: whether a mission's item 0 is home.
    """

    what = "upload"

    def __init__(
        self,
        plan_type: PlanType,
        items: Iterable[MissionItem],
        sysid: int,
        compid: int,
        send: Callable[[Message], None],
        now: Callable[[], float],
        known: Acquaintance | None = None,
        *,
        home_first: bool = True,
    ) -> None:
        super().__init__(plan_type, sysid, compid, send, now, known)
        self._items = tuple(items)
        self._home_first = home_first
        self._asked: set[int] = set()
        self._unsent = set(range(len(self._items)))
        self._last_asked = 0

    def _begin(self) -> None:
        self._asked.clear()
        self._unsent = set(range(len(self._items)))
        self._ask(mavlink.MAVLink_mission_count_message(*self._target, len(self._items), self._plan_type))

    def _take_plan_message(self, kind: str, message: Message) -> None:
        if kind in ("MISSION_REQUEST_INT", "MISSION_REQUEST"):
            if message.seq < len(self._items):
                self._take_request(message)
        elif kind == "MISSION_ACK":
            self._take_ack(int(message.type))

    def _take_request(self, message: Message) -> None:
        seq = self._last_asked = message.seq
        self._known.loss.measure(lost=seq in self._asked)
        if seq not in self._asked:
            if not self._asked:
                self._measure()
            self._progress()
            self._asked.add(seq)
            self._sent_at_s = self._now()
            self._set_deadline()
        else:
            self._tries = max(1, self._tries)  # what is sent again tells nothing of the round trip
        self._send_item(seq)

    def _take_ack(self, result: int) -> None:
        if result == mavlink.MAV_MISSION_INVALID_SEQUENCE:
            return
        all_sent = not self._unsent
        if result == mavlink.MAV_MISSION_ACCEPTED:
            if all_sent:
                self._measure()
                self.outcome = Uploaded(confirmed=True)
        elif result == mavlink.MAV_MISSION_ERROR and all_sent and self._tries > 0:
            # ArduPilot's word for an item when no upload is running any more: it had answered the first time.
            self.outcome = Uploaded(confirmed=False)
        else:
            self._take_refusal(result)

    def _repeat(self) -> None:
        quiet_s = self._now() - (self._last_heard[1] if self._last_heard else self._began_at_s)
        if not self._asked:
            self._send(self._waiting)
        elif not self._unsent and quiet_s >= _UNCONFIRMED_S:
            self.outcome = Uploaded(confirmed=False)
        elif quiet_s >= _LOST_S:
            self._begin_again(mavlink.MAV_MISSION_OPERATION_CANCELLED)
        else:
            last = len(self._items) - 1
            self._send_item(self._last_asked)
            self._send_item(min(self._last_asked + 1, last) if self._unsent else last)
        self._set_deadline()

    def _send_item(self, seq: int) -> None:
        self._unsent.discard(seq)
        item = item_message(self._items[seq], seq, *self._target, self._plan_type, home_first=self._home_first)
        self._send(item)

    def _give_up(self) -> "Uploaded | TransferError":
        return self._stopped() if self._unsent else Uploaded(confirmed=False)

    def _where(self) -> str:
        if not self._asked:
            return f"MISSION_COUNT {len(self._items)}"
        return f"item {self._last_asked} of {len(self._items)}"
