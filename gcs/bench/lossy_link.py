"""Both ends of a transfer over a link in memory that loses, delays, repeats and reorders; time is simulated."""

import heapq
import math
import random
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from gcs import station
from gcs.transfers.acquaintance import Acquaintance
from gcs.transfers.transfer import Transfer
from sitl.events import StatusText
from sitl.services.codec import Codec
from sitl.services.mission_server import MissionServer
from sitl.services.parameters import ParameterServer
from sitl.services.peer import Message, Peer
from sitl.services.vehicle import Vehicle

_PEER = Peer("udp", "127.0.0.1", 14550)
_LONGEST_STEP_S = 0.01
"""Time passes to the next arrival, but at most so far, for time-outs to be noticed."""


@dataclass
class Fates:
    """What becomes of the messages, one after the other, both ways; every kind counts, MISSION_ACK included.

    Attributes:
        lost: whether a message is lost.
        delay_s: what each takes.
        jitter_s: what a message takes longer, so that it may be overtaken.
        copies: how often it arrives.
    """

    lost: Callable[[], bool] = lambda: False
    delay_s: float = 0.02
    jitter_s: Callable[[], float] = lambda: 0.0
    copies: Callable[[], int] = lambda: 1


def seeded_fates(seed: int, loss: float, delay_s: float = 0.05, jitter_s: float = 0.0) -> Fates:
    """Fates by chance: `loss` of the messages each way; with jitter a tenth are repeated, and any may be overtaken."""
    chance = random.Random(seed)
    return Fates(
        lambda: chance.random() < loss,
        delay_s,
        lambda: chance.random() * jitter_s,
        lambda: 1 + (jitter_s > 0.0 and chance.random() < 0.1),
    )


class LossyLink:
    """A station's transfer and a vehicle's servers, joined.

    Args:
        vehicle: whose plans and parameters are served.
        fates: what becomes of the messages.

    Attributes:
        time_s: simulated time.
        known: what the station has learned of the vehicle.
        texts: what the vehicle has said.
        kinds_lost: the kinds of the messages that were lost.
    """

    def __init__(self, vehicle: Vehicle, fates: Fates) -> None:
        self.vehicle = vehicle
        self.time_s = 0.0
        self.known = Acquaintance()
        self.texts: list[str] = []
        self.kinds_lost: set[str] = set()
        self._fates = fates
        self._in_flight: list[tuple[float, int, bool, bytes]] = []
        self._counter = 0
        self._station, self._endpoint = Codec(station.SYSID, station.COMPID), Codec(vehicle.sysid, 1)
        self.start_endpoint()

    def start_endpoint(self) -> None:
        """A new process of the vehicle: it knows the plans that it has taken, and no transfer."""

        def answer(message: Message, _: Peer) -> None:
            self._put(False, message)

        def say(status: StatusText) -> None:
            self.texts.append(status.text)

        self._plans = MissionServer(self.vehicle, answer, say, self.now)
        self._parameters = ParameterServer(
            self.vehicle.parameters, answer, lambda message: answer(message, _PEER), say, self.now
        )

    def link(self) -> tuple[int, int, Callable[[Message], None], Callable[[], float], Acquaintance]:
        """The last arguments of a transfer: whom it is with, and how."""
        return (self.vehicle.sysid, 1, self.send, self.now, self.known)

    def now(self) -> float:
        """Simulated time."""
        return self.time_s

    def send(self, message: Message) -> None:
        """The station's `send`."""
        self._put(True, message)

    def run(self, transfer: Transfer[Any], patience_s: float = 300.0) -> Any:
        """Run a transfer to its outcome; raises AssertionError when it has none for so long."""
        transfer.start()
        self.go_on(transfer, lambda: transfer.outcome is not None, patience_s)
        assert transfer.outcome is not None, "the transfer neither ended nor gave up"
        return transfer.outcome

    def go_on(self, transfer: Transfer[Any], until: Callable[[], bool], patience_s: float = 300.0) -> None:
        """Let time pass until something is so, or for so long."""
        end_s = self.time_s + patience_s
        while not until() and self.time_s < end_s:
            self._step(transfer)

    def _put(self, up: bool, message: Message) -> None:
        frame = (self._station if up else self._endpoint).pack(message)
        if self._fates.lost():
            self.kinds_lost.add(message.get_type())
            return
        for _ in range(self._fates.copies()):
            self._counter += 1
            due_s = self.time_s + self._fates.delay_s + self._fates.jitter_s()
            heapq.heappush(self._in_flight, (due_s, self._counter, up, frame))

    def _step(self, transfer: Transfer[Any]) -> None:
        arrives_s = self._in_flight[0][0] if self._in_flight else math.inf
        self.time_s = max(self.time_s, min(self.time_s + _LONGEST_STEP_S, arrives_s))
        while self._in_flight and self._in_flight[0][0] <= self.time_s:
            _, _, up, frame = heapq.heappop(self._in_flight)
            for message in (self._endpoint if up else self._station).feed(frame):
                if up:
                    self._plans.on_message(message, _PEER)
                    self._parameters.on_message(message, _PEER)
                else:
                    transfer.on_message(message)
        transfer.on_tick()
        self._plans.on_tick()
        self._parameters.on_tick()
