"""What uploading, downloading and clearing a plan have in common: where they begin, and what they make of a refusal."""

import re
from abc import abstractmethod
from collections.abc import Callable
from typing import ClassVar

from pymavlink.dialects.v20 import ardupilotmega as mavlink

from gcs.transfers.acquaintance import Acquaintance
from gcs.transfers.errors import TransferError
from gcs.transfers.transfer import Result, Transfer
from missions.plan_type import PlanType
from sitl.services.peer import Message

STARTS = 5
"""How often one transfer begins, at most: anew each time that the vehicle has lost it or given it up."""

PAUSE_S = 1.0
"""Between one question and the next to a vehicle that is busy, or not ready yet."""

NOUNS = {PlanType.MISSION: "mission", PlanType.FENCE: "fence", PlanType.RALLY: "rally points"}

_HINTS = {
    int(mavlink.MAV_MISSION_DENIED): "another station may have a transfer running, or it is flying the mission",
    int(mavlink.MAV_MISSION_NO_SPACE): "it takes fewer items",
    int(mavlink.MAV_MISSION_UNSUPPORTED): "it cannot fly that",
    int(mavlink.MAV_MISSION_OPERATION_CANCELLED): "it gave up waiting, each time; check the link",
}
_UNREADY = "it is not ready to take any items"
_NOT_READY = re.compile(r"\b0 items")
"""ArduPilot has no room for any item until it is ready: "Only 0 items are supported"."""


class PlanTransfer(Transfer[Result]):
    """One plan of one vehicle: MISSION_* messages of one mission_type.

    A refusal is believed when it has been said twice. The first may be a late word of an earlier transfer, or the
    vehicle has been restarted in the middle: the transfer begins again, and what is in flight from the first start is
    not heard.

    Args:
        plan_type: which of the vehicle's plans.
        sysid, compid, send, now, known: as of Transfer.
    """

    what: ClassVar[str]
    """What this does with a plan, for people."""

    def __init__(
        self,
        plan_type: PlanType,
        sysid: int,
        compid: int,
        send: Callable[[Message], None],
        now: Callable[[], float],
        known: Acquaintance | None = None,
    ) -> None:
        super().__init__(sysid, compid, send, now, known)
        self._plan_type = plan_type
        self._starts = 0
        self._began_at_s = now()
        self._taken_up = False
        self._refused = False
        self._not_ready = False

    def start(self) -> None:
        """Send the message that a transfer begins with."""
        self._starts += 1
        self._began_at_s = self._now()
        self._taken_up = False
        self._begin()

    def cancel(self) -> None:
        """Tell the vehicle with MISSION_ACK that the transfer is over."""
        cancelled = mavlink.MAV_MISSION_OPERATION_CANCELLED
        self._send(mavlink.MAVLink_mission_ack_message(*self._target, cancelled, self._plan_type))

    @abstractmethod
    def _begin(self) -> None:
        """Forget what there is so far, and send the first message."""

    def _ask(self, message: Message) -> None:
        super()._ask(message)
        for _ in range(1, self._known.loss.copies):
            self._send(message)

    def _timeout_s(self, tries: int) -> float:
        # What a transfer begins with is short, and harmless however often it comes.
        known = self._known.round_trip.smoothed_s is not None
        return super()._timeout_s(tries) / (1.0 if known else 2.0)

    @abstractmethod
    def _take_plan_message(self, kind: str, message: Message) -> None:
        """Act on one MISSION_* message of this type of plan."""

    @abstractmethod
    def _where(self) -> str:
        """How far it has got, for people."""

    def _take(self, message: Message) -> None:
        kind = message.get_type()
        if kind == "STATUSTEXT":
            self._not_ready = self._not_ready or _NOT_READY.search(message.text) is not None
        elif kind.startswith("MISSION_") and getattr(message, "mission_type", None) == self._plan_type:
            self._heard(message)
            self._take_plan_message(kind, message)

    def _progress(self) -> None:
        # What comes sooner after a start than any answer could still belongs to the start before.
        soonest_s = (self._known.round_trip.smoothed_s or 0.0) / 2
        self._taken_up = self._taken_up or self._now() >= self._began_at_s + soonest_s
        super()._progress()

    def _begin_again(self, result: int) -> None:
        """Begin once more, unless it has done so often enough; then the outcome is this refusal."""
        if self._starts < STARTS:
            self.start()
        else:
            self.outcome = self._refusal(result)

    def _take_refusal(self, result: int) -> None:
        """The vehicle has answered with an error."""
        if self._is_late():
            return
        if self._may_pass(result):
            self.deadline_s = self._now() + PAUSE_S
        elif result == mavlink.MAV_MISSION_OPERATION_CANCELLED or not self._refused:
            self._refused = self._refused or result != mavlink.MAV_MISSION_OPERATION_CANCELLED
            self._begin_again(result)
        else:
            self.outcome = self._refusal(result)

    def _is_late(self) -> bool:
        """Whether a refusal may still belong to the start before this one."""
        return self._starts > 1 and not self._taken_up and self._now() - self._began_at_s < self._timeout_s(0)

    def _may_pass(self, result: int) -> bool:
        """Whether a refusal is one for the time being: then the last message is sent again after a pause."""
        waited_s = self._now() - self._progress_at_s
        return result == mavlink.MAV_MISSION_NO_SPACE and self._not_ready and waited_s < self.stuck_s

    def _refusal(self, result: int) -> TransferError:
        entry = mavlink.enums["MAV_MISSION_RESULT"].get(result)
        name = entry.name if entry is not None else f"result {result}"
        unready = result == mavlink.MAV_MISSION_NO_SPACE and self._not_ready
        hint = _UNREADY if unready else _HINTS.get(result)
        return self._error(f"{self._name} refused at {self._where()} with {name}" + (f" ({hint})" if hint else ""))

    def _stopped(self) -> TransferError:
        """The error when there is no hope; the vehicle is told, should it still listen."""
        self.cancel()
        reason = _UNREADY if self._not_ready else "no answer; check the link and try again"
        return self._error(f"{self._name} stopped at {self._where()}: {reason}")

    @property
    def _name(self) -> str:
        return f"{NOUNS[self._plan_type]} {self.what}"
