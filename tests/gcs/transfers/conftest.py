"""Both ends of a transfer over an in-memory link that loses what it is told to."""

import heapq
import math
from collections.abc import Callable
from typing import Any

import pytest

from gcs import station
from gcs.transfers.acquaintance import Acquaintance
from gcs.transfers.transfer import Transfer
from sitl.events import StatusText
from sitl.services.codec import Codec
from sitl.services.mission_server import MissionServer
from sitl.services.parameters import ParameterServer
from sitl.services.peer import Peer

PEER = Peer("udp", "127.0.0.1", 14550)


class LossyLink:
    """A station's transfer and a vehicle's server with a delay between them; time is simulated.

    Args:
        vehicle: the fake vehicle served.
        lost: called for each message in turn, whether that one is lost; every kind counts, MISSION_ACK included.
        delay_s: one way.
        jitter_s: called for each message: what it takes longer, so that it may be overtaken.
        copies: called for each message: how often it arrives.
    """

    def __init__(
        self,
        vehicle: Any,
        lost: Callable[[], bool] = lambda: False,
        delay_s: float = 0.02,
        jitter_s: Callable[[], float] = lambda: 0.0,
        copies: Callable[[], int] = lambda: 1,
    ) -> None:
        self.vehicle = vehicle
        self.time_s = 0.0
        self.texts: list[str] = []
        self.kinds_lost: set[str] = set()
        self._lost = lost
        self._delay_s = delay_s
        self._jitter_s = jitter_s
        self._copies = copies
        self._in_flight: list[tuple[float, int, str, bytes]] = []
        self._counter = 0
        self._up, self._down = Codec(station.SYSID, station.COMPID), Codec(vehicle.sysid, 1)
        self.known = Acquaintance()
        self.start_endpoint()

    def start_endpoint(self) -> None:
        """A new process of the vehicle: it knows the plans that it has taken, and no transfer."""
        vehicle = self.vehicle

        def answer(message: Any, _: Peer) -> None:
            self._put("down", message, self._down)

        def say(status: StatusText) -> None:
            self.texts.append(status.text)

        self.server = MissionServer(vehicle, answer, say, self.now)
        self.parameters = ParameterServer(
            vehicle.parameters, answer, lambda message: answer(message, PEER), say, self.now
        )

    def link(self) -> tuple[Any, ...]:
        """The last arguments of a transfer: whom it is with, and how."""
        return (self.vehicle.sysid, 1, self.send, self.now, self.known)

    def now(self) -> float:
        return self.time_s

    def send(self, message: Any) -> None:
        """The station's `send`."""
        self._put("up", message, self._up)

    def run(self, transfer: Transfer[Any], patience_s: float = 300.0) -> Any:
        """Run a transfer to its outcome."""
        transfer.start()
        self.go_on(transfer, lambda: transfer.outcome is not None, patience_s)
        assert transfer.outcome is not None, "the transfer neither ended nor gave up"
        return transfer.outcome

    def go_on(self, transfer: Transfer[Any], until: Callable[[], bool], patience_s: float = 300.0) -> None:
        """Let time pass until something is so, or for so long."""
        end_s = self.time_s + patience_s
        while not until() and self.time_s < end_s:
            self._step(transfer)

    def _put(self, way: str, message: Any, codec: Codec) -> None:
        frame = codec.pack(message)
        if self._lost():
            self.kinds_lost.add(message.get_type())
            return
        for _ in range(self._copies()):
            self._counter += 1
            due_s = self.time_s + self._delay_s + self._jitter_s()
            heapq.heappush(self._in_flight, (due_s, self._counter, way, frame))

    def _step(self, transfer: Transfer[Any]) -> None:
        arrives_s = self._in_flight[0][0] if self._in_flight else math.inf
        self.time_s = max(self.time_s, min(self.time_s + 0.01, arrives_s))
        while self._in_flight and self._in_flight[0][0] <= self.time_s:
            _, _, way, frame = heapq.heappop(self._in_flight)
            if way == "up":
                for message in self._down.feed(frame):
                    self.server.on_message(message, PEER)
                    self.parameters.on_message(message, PEER)
            else:
                for message in self._up.feed(frame):
                    transfer.on_message(message)
        transfer.on_tick()
        self.server.on_tick()
        self.parameters.on_tick()


class Scripted:
    """A transfer with a vehicle that says what a test makes it say; time is simulated.

    Attributes:
        sent: (kind, seq) of what the transfer has sent; seq is the type of a MISSION_ACK, None where there is none.
    """

    def __init__(self) -> None:
        self.time_s = 0.0
        self.sent: list[tuple[str, int | None]] = []
        self.known = Acquaintance()
        self._transfer: Transfer[Any] | None = None
        self._ours, self._theirs = Codec(station.SYSID, station.COMPID), Codec(3, 1)

    def link(self) -> tuple[Any, ...]:
        """The last arguments of a transfer."""
        return (3, 1, self._send, lambda: self.time_s, self.known)

    def start(self, transfer: Transfer[Any]) -> None:
        self._transfer = transfer
        transfer.start()

    def say(self, message: Any) -> None:
        """The vehicle says something."""
        assert self._transfer is not None
        self._transfer.on_message(self._ours.feed(self._theirs.pack(message))[0])

    def wait(self, seconds: float) -> None:
        """Time passes."""
        assert self._transfer is not None
        end_s = self.time_s + seconds
        while self.time_s < end_s:
            self.time_s += 0.05
            self._transfer.on_tick()

    def _send(self, message: Any) -> None:
        self.sent.append((message.get_type(), getattr(message, "seq", getattr(message, "type", None))))


@pytest.fixture
def scripted() -> Scripted:
    return Scripted()


@pytest.fixture
def lossy_link() -> type[LossyLink]:
    return LossyLink
