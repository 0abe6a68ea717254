"""Both ends of a transfer over an in-memory link that loses what it is told to."""

import heapq
from collections.abc import Callable
from typing import Any

import pytest

from gcs import station
from gcs.transfers.transfer import Transfer
from sitl.services.codec import Codec
from sitl.services.mission_server import MissionServer
from sitl.services.peer import Peer

PEER = Peer("udp", "127.0.0.1", 14550)


class LossyLink:
    """A station's transfer and a vehicle's server with a delay between them; time is simulated.

    Args:
        vehicle: the fake vehicle served.
        lost: called for each message in turn, whether that one is lost; every kind counts, MISSION_ACK included.
        delay_s: one way.
    """

    def __init__(self, vehicle: Any, lost: Callable[[], bool] = lambda: False, delay_s: float = 0.02) -> None:
        self.vehicle = vehicle
        self.time_s = 0.0
        self.texts: list[str] = []
        self.kinds_lost: set[str] = set()
        self._lost = lost
        self._delay_s = delay_s
        self._in_flight: list[tuple[float, int, str, bytes]] = []
        self._counter = 0
        self._up, self._down = Codec(station.SYSID, station.COMPID), Codec(vehicle.sysid, 1)
        self.server = MissionServer(
            vehicle,
            lambda message, _: self._put("down", message, self._down),
            lambda status: self.texts.append(status.text),
            self.now,
        )

    def now(self) -> float:
        return self.time_s

    def send(self, message: Any) -> None:
        """The station's `send`."""
        self._put("up", message, self._up)

    def run(self, transfer: Transfer[Any], until_s: float = 300.0) -> Any:
        """Run a transfer to its outcome, then let the server come to rest."""
        transfer.start()
        while transfer.outcome is None and self.time_s < until_s:
            self._step(transfer)
        assert transfer.outcome is not None, "the transfer neither ended nor gave up"
        end_s = self.time_s + 10.0
        while self.time_s < end_s:
            self._step(transfer)
        return transfer.outcome

    def _put(self, way: str, message: Any, codec: Codec) -> None:
        frame = codec.pack(message)
        if self._lost():
            self.kinds_lost.add(message.get_type())
            return
        self._counter += 1
        heapq.heappush(self._in_flight, (self.time_s + self._delay_s, self._counter, way, frame))

    def _step(self, transfer: Transfer[Any]) -> None:
        self.time_s += 0.01
        while self._in_flight and self._in_flight[0][0] <= self.time_s:
            _, _, way, frame = heapq.heappop(self._in_flight)
            if way == "up":
                for message in self._down.feed(frame):
                    self.server.on_message(message, PEER)
            else:
                for message in self._up.feed(frame):
                    transfer.on_message(message)
        transfer.on_tick()
        self.server.on_tick()


@pytest.fixture
def lossy_link() -> type[LossyLink]:
    return LossyLink
