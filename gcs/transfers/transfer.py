"""What the transfers have in common: one message at a time that waits for its answer, repeated until it comes."""

from abc import ABC, abstractmethod
from collections.abc import Callable
from typing import Generic, TypeVar

from gcs.station import is_for_station
from gcs.transfers.errors import TransferError
from sitl.services.peer import Message
from sitl.services.round_trip import TRIES, RoundTrip

Result = TypeVar("Result")


class Transfer(ABC, Generic[Result]):
    """A conversation with one vehicle. Start it, feed it messages and ticks, read `outcome`.

    Args:
        sysid, compid: the vehicle.
        send: called with each MAVLink message to put on the wire.
        now: current time in seconds; only differences matter.

    Attributes:
        outcome: the result or the error; None while it goes on.
        deadline_s: when `on_tick` has something to do next.
    """

    def __init__(self, sysid: int, compid: int, send: Callable[[Message], None], now: Callable[[], float]) -> None:
        self.outcome: Result | TransferError | None = None
        self.deadline_s = now()
        self._target = (sysid, compid)
        self._send = send
        self._now = now
        self._round_trip = RoundTrip()
        self._waiting: Message | None = None
        self._sent_at_s = now()
        self._tries = 0
        self._shortest_wait_s = 0.0
        self._last_heard: tuple[str, float] | None = None

    @abstractmethod
    def start(self) -> None:
        """Send the first message."""

    @abstractmethod
    def _take(self, message: Message) -> None:
        """Act on one message from the vehicle."""

    @abstractmethod
    def _give_up(self) -> "Result | TransferError":
        """The outcome after the last repeat has gone unanswered."""

    def on_message(self, message: Message) -> None:
        """Take one message from the vehicle; what does not belong to the transfer is ignored."""
        if self.outcome is None and is_for_station(message):
            self._take(message)

    def on_tick(self) -> None:
        """Repeat the message whose answer is overdue, or give up."""
        if self.outcome is not None or self._now() < self.deadline_s or self._waiting is None:
            return
        if self._tries >= TRIES:
            self.outcome = self._give_up()
            return
        self._tries += 1
        self._send(self._waiting)
        self._set_deadline()

    def _ask(self, message: Message, shortest_wait_s: float = 0.0) -> None:
        """Send a message that wants an answer, after the previous one has got its own: this is progress."""
        self._waiting = message
        self._tries = 0
        self._shortest_wait_s = shortest_wait_s
        self._sent_at_s = self._now()
        self._send(message)
        self._set_deadline()

    def _answered(self, message: Message) -> None:
        """The waiting message has been answered: note how long that took."""
        if self._tries == 0:
            self._round_trip.measure(self._now() - self._sent_at_s)
        self._heard(message)

    def _heard(self, message: Message) -> None:
        seq = getattr(message, "seq", None)
        self._last_heard = (message.get_type() if seq is None else f"{message.get_type()} {seq}", self._now())

    def _set_deadline(self) -> None:
        self.deadline_s = self._now() + max(self._shortest_wait_s, self._round_trip.timeout_s(self._tries))

    def _error(self, what: str) -> TransferError:
        """An error that names the vehicle and what was last heard of it."""
        if self._last_heard is None:
            heard = "nothing heard in this transfer"
        else:
            kind, at_s = self._last_heard
            heard = f"last heard {kind}, {self._now() - at_s:.1f} s ago"
        return TransferError(f"vehicle {self._target[0]}: {what}; {heard}")
