"""A relay between real sockets that loses and delays what it carries, message by message, as a seed says."""

import contextlib
import heapq
import random
import selectors
import socket
import threading
import time

from gcs.bench.peers import LOOPBACK
from sitl.services.codec import Codec

_LARGEST_DATAGRAM = 65536


class LossyRelay:
    """Carries MAVLink between one station and one endpoint, in a thread of its own. Close it.

    The station talks to `port`; what it says leaves for the endpoint from another socket. Of a datagram arrives what is
    left of its messages.

    Args:
        endpoint_port: the endpoint's UDP port.
        loss: part of the messages that is lost, each way.
        seed: of the losses.
        delay_s: what a message takes, each way.

    Attributes:
        port: for the station.
        kinds_lost: the kinds of the messages that were lost.
    """

    def __init__(self, endpoint_port: int, loss: float, seed: int, delay_s: float = 0.0) -> None:
        self.kinds_lost: set[str] = set()
        self._random = random.Random(seed)
        self._loss = loss
        self._delay_s = delay_s
        self._near = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self._near.bind((LOOPBACK, 0))
        self._far = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self._far.connect((LOOPBACK, endpoint_port))
        self._station: tuple[str, int] | None = None
        self._readers = {self._near: Codec(0, 0), self._far: Codec(0, 0)}
        self._in_flight: list[tuple[float, int, bool, bytes]] = []
        self._counter = 0
        self._wake, self._stop = socket.socketpair()
        self.port = int(self._near.getsockname()[1])
        self._thread = threading.Thread(target=self._run, name="relay")
        self._thread.start()

    def close(self) -> None:
        """Stop carrying, and close the sockets."""
        self._stop.send(b"\0")
        self._thread.join()
        for end in (self._near, self._far, self._wake, self._stop):
            end.close()

    def _run(self) -> None:
        with selectors.DefaultSelector() as selector:
            for end in (self._near, self._far, self._wake):
                selector.register(end, selectors.EVENT_READ)
            while True:
                wait_s = max(0.0, self._in_flight[0][0] - time.monotonic()) if self._in_flight else None
                for key, _ in selector.select(wait_s):
                    if key.fileobj is self._wake:
                        return
                    with contextlib.suppress(ConnectionRefusedError):
                        self._take(self._near if key.fileobj is self._near else self._far)
                with contextlib.suppress(ConnectionRefusedError):
                    self._deliver()

    def _take(self, end: socket.socket) -> None:
        data, sender = end.recvfrom(_LARGEST_DATAGRAM)
        if end is self._near:
            self._station = sender
        left = b"".join(
            message.get_msgbuf() for message in self._readers[end].feed(data) if self._survives(message.get_type())
        )
        if left:
            self._counter += 1
            due_s = time.monotonic() + self._delay_s
            heapq.heappush(self._in_flight, (due_s, self._counter, end is self._near, left))

    def _survives(self, kind: str) -> bool:
        if self._random.random() < self._loss:
            self.kinds_lost.add(kind)
            return False
        return True

    def _deliver(self) -> None:
        while self._in_flight and self._in_flight[0][0] <= time.monotonic():
            _, _, up, data = heapq.heappop(self._in_flight)
            if up:
                self._far.send(data)
            elif self._station is not None:
                self._near.sendto(data, self._station)
