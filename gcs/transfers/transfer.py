"""What all transfers have in common: messages that want an answer, repeated until it comes or there is no hope."""

import logging
from abc import ABC, abstractmethod
from collections.abc import Callable
from typing import ClassVar, Generic, TypeVar

from gcs.station import is_for_station
from gcs.transfers.acquaintance import Acquaintance
from gcs.transfers.errors import TransferError
from sitl.services.peer import Message
from sitl.services.round_trip import TRIES

_log = logging.getLogger(__name__)

Result = TypeVar("Result")

SILENT_S = 12.0
"""A vehicle of which nothing at all is heard for so long is out of reach."""

STUCK_S = 30.0
"""A transfer with a vehicle that is heard, but makes no progress for so long, is given up."""

_TRIES_AT_ONE_PACE = 3
_DOUBLINGS = 1
"""Loss on a radio link is no sign of congestion: to wait much longer would only make the transfer longer."""

_SHORTEST_S = 0.1
_LONGEST_S = 5.0
"""The least and the most time that a vehicle is given for an answer, however quick or slow the link."""


class Transfer(ABC, Generic[Result]):
    """A conversation with one vehicle. Start it, feed it messages and ticks, read `outcome`.

    Args:
        sysid, compid: the vehicle.
        send: called with each MAVLink message to put on the wire.
        now: current time in seconds; only differences matter.
        known: what earlier transfers have learned of the vehicle, and this one adds to.

    Attributes:
        outcome: the result or the error; None while it goes on.
        deadline_s: when `on_tick` has something to do next.
    """

    stuck_s: ClassVar[float] = STUCK_S

    def __init__(
        self,
        sysid: int,
        compid: int,
        send: Callable[[Message], None],
        now: Callable[[], float],
        known: Acquaintance | None = None,
    ) -> None:
        self.outcome: Result | TransferError | None = None
        self.deadline_s = now()
        self._target = (sysid, compid)
        self._send = send
        self._now = now
        self._known = known or Acquaintance()
        self._waiting: Message | None = None
        self._sent_at_s = self._progress_at_s = self._heard_at_s = now()
        self._tries = 0
        self._last_heard: tuple[str, float] | None = None

    @abstractmethod
    def start(self) -> None:
        """Send the first message."""

    @abstractmethod
    def _take(self, message: Message) -> None:
        """Act on one message from the vehicle."""

    @abstractmethod
    def _give_up(self) -> "Result | TransferError":
        """The outcome when there is no hope of progress."""

    def cancel(self) -> None:
        """The station no longer wants it: tell the vehicle, where it has to know."""

    def on_message(self, message: Message) -> None:
        """Take one message from the vehicle; what does not belong to the transfer only shows that it is there."""
        if self.outcome is None and is_for_station(message):
            self._heard_at_s = self._now()
            self._take(message)

    def on_tick(self) -> None:
        """Repeat what is overdue, or give up."""
        now_s = self._now()
        if self.outcome is not None or now_s < self.deadline_s:
            return
        silent, stuck = now_s - self._heard_at_s >= SILENT_S, now_s - self._progress_at_s >= self.stuck_s
        if self._tries >= TRIES and (silent or stuck):
            self.outcome = self._give_up()
            return
        self._tries += 1
        _log.info("vehicle %d: %s: no answer in time, try %d", self._target[0], type(self).__name__, self._tries + 1)
        self._repeat()

    def _repeat(self) -> None:
        """Send again what has not been answered."""
        self._send(self._waiting)
        self._set_deadline()

    def _ask(self, message: Message) -> None:
        """Send a message that wants an answer, and repeat it from now on."""
        self._waiting = message
        self._tries = 0
        self._sent_at_s = self._now()
        self._send(message)
        self._set_deadline()

    def _progress(self) -> None:
        """The vehicle has come a step further."""
        self._progress_at_s = self._now()
        self._tries = 0

    def _answered(self, message: Message) -> None:
        """The waiting message has been answered: note how long that took."""
        self._measure()
        self._heard(message)
        self._progress()

    def _measure(self) -> None:
        """What comes now answers what was sent last; how long that took is known if it was sent only once."""
        if self._tries == 0:
            self._known.round_trip.measure(self._now() - self._sent_at_s)

    def _heard(self, message: Message) -> None:
        seq = getattr(message, "seq", None)
        self._last_heard = (message.get_type() if seq is None else f"{message.get_type()} {seq}", self._now())

    def _set_deadline(self) -> None:
        self.deadline_s = self._now() + self._timeout_s(self._tries // _TRIES_AT_ONE_PACE)

    def _timeout_s(self, tries: int) -> float:
        return min(_LONGEST_S, self._known.round_trip.timeout_s(min(tries, _DOUBLINGS), _SHORTEST_S))

    def _error(self, what: str) -> TransferError:
        """An error that names the vehicle and what was last heard of it."""
        if self._last_heard is None:
            heard = "nothing heard in this transfer"
        else:
            kind, at_s = self._last_heard
            heard = f"last heard {kind}, {self._now() - at_s:.1f} s ago"
        return TransferError(f"vehicle {self._target[0]}: {what}; {heard}")
