"""Downloading a plan: the station's side of the MAVLink mission protocol."""

from collections import deque
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

from pymavlink.dialects.v20 import ardupilotmega as mavlink

from gcs.transfers.acquaintance import Acquaintance
from gcs.transfers.errors import TransferError
from gcs.transfers.plan_transfer import STARTS, PlanTransfer
from missions.mission import MissionItem
from missions.plan_type import PlanType
from sitl.services.loss import learn
from sitl.services.mission_items import decode_item
from sitl.services.opaque_id import received_opaque_id
from sitl.services.peer import Message
from sitl.services.request_window import UNMEASURED

WINDOW = 32
"""Requests on their way, copies included; the items that answer them are 1.6 kB, 0.3 s of a radio of 57600 baud."""

_BUSY_S = 10.0
"""A vehicle that denies a download while an upload runs is asked again for so long."""

_TRIES_AT_ONE_PACE = 4
"""What is lost on a radio is no sign of a queue: repeats slow down late."""

_LATER_ANSWERS = 3
"""A request is lost once one that was sent so many later has been answered."""

_UNANSWERED_TRIES = 7
"""A peer that leaves the lowest request unanswered so often, and all others meanwhile, may want strict order."""

_FORGOTTEN_TRIES = 10
_FORGOTTEN_S = 10.0
"""A peer asked for one item alone that leaves it unanswered so often, and sends no other for so long, has ended the
download: PX4 does at a request out of turn, says so once, which may be lost, and is silent from then on."""
_THERE_S = 5.0
"""It is there all the same, if something has been heard of it for so long: a heartbeat, for the most part."""


@dataclass
class _Request:
    """A request that is outstanding.

    Attributes:
        first_at_s, sent_at_s: when it was sent first, and last.
        serial: as the how manyth of all that was.
        tries: how often it had been sent before.
        copies: how often it was sent at once.
    """

    first_at_s: float
    sent_at_s: float
    serial: int
    tries: int
    copies: int


class PlanDownload(PlanTransfer[tuple[MissionItem, ...]]):
    """Pulls one plan that a vehicle holds, with a window of requests; items may come in any order.

    Each request is repeated by itself. A vehicle that wants them in strict order is asked for one at a time: from the
    start when it says so, with INVALID_SEQUENCE or an error, and from where it is when it shows it by silence. When
    the silence goes on, it is asked from the start.

    Args:
        plan_type, sysid, compid, send, now, known: as of PlanTransfer.
    """

    what = "download"

    def __init__(
        self,
        plan_type: PlanType,
        sysid: int,
        compid: int,
        send: Callable[[Message], None],
        now: Callable[[], float],
        known: Acquaintance | None = None,
    ) -> None:
        super().__init__(plan_type, sysid, compid, send, now, known)
        self._strict = self._known.strict
        self._plan: tuple[int, int] | None = None  # count and opaque id
        self._window = WINDOW
        self._items: dict[int, MissionItem] = {}
        self._pending: deque[int] = deque()
        self._requests: dict[int, _Request] = {}  # in the order in which they were sent
        self._serial = 0

    def _begin(self) -> None:
        self._plan = None
        self._ask(mavlink.MAVLink_mission_request_list_message(*self._target, self._plan_type))

    def _take_plan_message(self, kind: str, message: Message) -> None:
        if kind == "MISSION_ITEM_INT":
            if self._plan is not None and message.seq < self._plan[0] and message.seq not in self._items:
                self._take_item(message)
        elif kind == "MISSION_COUNT":
            self._take_count(message)
        elif kind == "MISSION_ACK" and message.type != mavlink.MAV_MISSION_ACCEPTED:
            self._take_error(int(message.type))

    def _take_count(self, message: Message) -> None:
        plan = (int(message.count), received_opaque_id(message))
        if plan == self._plan:
            return
        if self._plan is None:
            self._answered(message)
        else:  # the plan has been changed meanwhile, or one of the two is late: ask which
            self._begin_again(mavlink.MAV_MISSION_ERROR)
            return
        self._plan = plan
        self._items = {}
        self._requests = {}
        self._pending = deque(range(plan[0]))
        self._window = 1 if self._strict else WINDOW
        self._go_on()

    def _take_item(self, message: Message) -> None:
        seq = message.seq
        self._items[seq] = decode_item(message)
        self._progress()
        request = self._requests.pop(seq, None)
        if request is None:
            self._pending.remove(seq)
        else:
            now_s = self._now()
            since_first_s = now_s - request.first_at_s if request.tries else None
            if learn(self._known.round_trip, self._known.loss, now_s - request.sent_at_s, since_first_s):
                self._request(self._overtaken(request.serial))
        self._go_on()

    def _overtaken(self, answered: int) -> list[int]:
        """What was sent long enough before a request that has been answered."""
        lost = []
        for seq, request in self._requests.items():
            if request.serial > answered - _LATER_ANSWERS:
                break
            lost.append(seq)
        return lost

    def _take_error(self, result: int) -> None:
        out_of_order = result in (mavlink.MAV_MISSION_INVALID_SEQUENCE, mavlink.MAV_MISSION_ERROR)
        if self._plan is not None and out_of_order and not self._strict:
            self._known.strict = self._strict = True
            self._begin_again(result)
        else:
            self._take_refusal(result)

    def _may_pass(self, result: int) -> bool:
        return result == mavlink.MAV_MISSION_DENIED and self._now() - self._progress_at_s < _BUSY_S

    def _go_on(self) -> None:
        """Ask for the next items that the window has room for, or thank for the last."""
        if not self._pending and not self._requests:
            accepted = mavlink.MAV_MISSION_ACCEPTED
            self._send(mavlink.MAVLink_mission_ack_message(*self._target, accepted, self._plan_type))
            self.outcome = tuple(self._items[seq] for seq in range(len(self._items)))
            return
        room = max(0, min(self._room(), len(self._pending)))
        self._request([self._pending.popleft() for _ in range(room)])
        self.deadline_s = next(iter(self._requests.values())).sent_at_s + self._timeout_s(0)  # or later: see _repeat

    def _repeat(self) -> None:
        if self._plan is None:
            self._send(self._waiting)  # twice: to ask once more costs less than to wait once more
            super()._repeat()
            return
        now_s = self._now()
        lowest = min(self._requests)
        tries, quiet_s = self._requests[lowest].tries, now_s - self._progress_at_s
        if self._strict:
            there = now_s - self._heard_at_s < _THERE_S
            if there and tries >= _FORGOTTEN_TRIES and quiet_s >= _FORGOTTEN_S and self._starts < STARTS:
                self.start()
                return
        elif tries >= _UNANSWERED_TRIES and quiet_s >= _UNANSWERED_TRIES * self._timeout_s(0):
            self._narrow(lowest)
        self._request([seq for seq, request in self._requests.items() if self._due_at_s(request) <= now_s])
        self.deadline_s = min(map(self._due_at_s, self._requests.values()))

    def _due_at_s(self, request: _Request) -> float:
        """When it is overdue, by what is known of the round trip by now."""
        return request.sent_at_s + self._timeout_s(request.tries // _TRIES_AT_ONE_PACE)

    def _narrow(self, lowest: int) -> None:
        """Ask for nothing but the lowest item that is missing: it is what a vehicle in strict order waits for."""
        self._strict = True
        self._window = 1
        later = sorted(seq for seq in self._requests if seq != lowest)
        self._pending.extendleft(reversed(later))
        self._requests = {lowest: replace(self._requests[lowest], tries=0)}

    def _room(self) -> int:
        """How many more requests may be on their way."""
        unmeasured = self._known.round_trip.smoothed_s is None
        return (min(self._window, UNMEASURED) if unmeasured else self._window) - sum(
            request.copies for request in self._requests.values()
        )

    def _request(self, seqs: Sequence[int]) -> None:
        """Ask for items, again or for the first time; on a link that loses, in copies that there is room for."""
        if not seqs:
            return
        before = [self._requests.pop(seq, None) for seq in seqs]
        copies = max(1, min(self._known.loss.copies, self._room() // len(seqs)))
        now_s = self._now()
        for seq, earlier in zip(seqs, before, strict=True):
            self._serial += 1
            first_at_s, tries = (now_s, 0) if earlier is None else (earlier.first_at_s, earlier.tries + 1)
            self._requests[seq] = _Request(first_at_s, now_s, self._serial, tries, copies)
        for seq in [*seqs] * copies:
            self._send(mavlink.MAVLink_mission_request_int_message(*self._target, seq, self._plan_type))

    def _give_up(self) -> "tuple[MissionItem, ...] | TransferError":
        return self._stopped()

    def _where(self) -> str:
        if self._plan is None:
            return "MISSION_REQUEST_LIST"
        missing = next((seq for seq in range(self._plan[0]) if seq not in self._items), self._plan[0])
        return f"item {missing} of {self._plan[0]}"
