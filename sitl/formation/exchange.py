"""Corrections over Zenoh: what a vehicle says and what it hears, tick by tick (DESIGN, Corrections over Zenoh)."""

import queue
import time
from collections.abc import Callable, Iterable

import zenoh

from sitl.formation.correction import Correction, decode, encode
from sitl.zenoh_session import alive_key, correction_key

_Message = tuple[int, bytes | bool]
"""From a neighbour: a message, or whether it is there."""


class Exchange:
    """Publishes the own corrections and waits for the neighbours'.

    In lockstep a vehicle at tick n waits for its neighbours' samples of an earlier tick. A neighbour whose liveliness
    token has gone is waited for no longer.

    Args:
        session: open; closed by its owner.
        swarm: part of every key.
        sysid: own.
        neighbours: sysids to listen to.

    Attributes:
        rejected: messages that were not a neighbour's samples.
        gone: neighbours that have been there and are no more.
    """

    def __init__(self, session: zenoh.Session, swarm: str, sysid: int, neighbours: Iterable[int]) -> None:
        self.neighbours = tuple(sorted(neighbours))
        self.rejected = 0
        self.gone: set[int] = set()
        self._present: set[int] = set()
        self._stopped = False
        self._samples: dict[int, dict[int, Correction]] = {neighbour: {} for neighbour in self.neighbours}
        self._newest = dict.fromkeys(self.neighbours, -1)
        self._unsent: list[bytes] = []
        # Zenoh's threads only put into the inbox; everything else is the caller's thread's.
        self._inbox: queue.SimpleQueue[_Message | None] = queue.SimpleQueue()
        self._publisher = session.declare_publisher(
            correction_key(swarm, sysid),
            congestion_control=zenoh.CongestionControl.BLOCK,
            priority=zenoh.Priority.REAL_TIME,
            express=False,
        )
        for neighbour in self.neighbours:
            session.declare_subscriber(
                correction_key(swarm, neighbour),
                zenoh.handlers.Callback(self._sample_putter(neighbour), indirect=False),
            )
            session.liveliness().declare_subscriber(
                alive_key(swarm, neighbour),
                zenoh.handlers.Callback(self._liveliness_putter(neighbour), indirect=False),
                history=True,
            )

    def wait_for_neighbours(self, timeout_s: float) -> set[int]:
        """Wait until all neighbours are there; returns those that are not when the time is over."""
        deadline = time.monotonic() + timeout_s
        while missing := set(self.neighbours) - self._present:
            try:
                self._take(self._inbox.get(timeout=max(0.0, deadline - time.monotonic())))
            except queue.Empty:
                return missing
            if self._stopped:
                return missing
        return set()

    def publish(self, sample: Correction, *, now: bool) -> None:
        """Tell the neighbours the own deviation: now, or together with later ones in one message."""
        self._unsent.append(encode(sample))
        if now:
            self._publisher.put(b"".join(self._unsent))
            self._unsent.clear()

    def gather(self, tick: int) -> dict[int, Correction]:
        """The samples of a tick, waited for, of all neighbours that are there; none when `stop` was called."""
        heard = {}
        for neighbour in self.neighbours:
            while self._newest[neighbour] < tick and neighbour not in self.gone and not self._stopped:
                self._take(self._inbox.get())
            sample = self._samples[neighbour].pop(tick, None)
            if sample is not None:
                heard[neighbour] = sample
        return heard

    def stop(self) -> None:
        """Wake a waiting `gather`, from any thread; it waits no more."""
        self._inbox.put(None)

    def _take(self, message: _Message | None) -> None:
        if message is None:
            self._stopped = True
            return
        neighbour, content = message
        if content is True:
            self._present.add(neighbour)
        elif content is False:
            self._present.discard(neighbour)
            self.gone.add(neighbour)
        else:
            self._take_samples(neighbour, content)

    def _take_samples(self, neighbour: int, payload: bytes) -> None:
        try:
            samples = decode(payload)
        except ValueError:
            self.rejected += 1
            return
        if any(sample.sysid != neighbour for sample in samples):
            self.rejected += 1
            return
        for sample in samples:
            self._samples[neighbour][sample.tick] = sample
            self._newest[neighbour] = max(self._newest[neighbour], sample.tick)

    def _sample_putter(self, neighbour: int) -> Callable[[zenoh.Sample], None]:
        return lambda sample: self._inbox.put((neighbour, sample.payload.to_bytes()))

    def _liveliness_putter(self, neighbour: int) -> Callable[[zenoh.Sample], None]:
        return lambda sample: self._inbox.put((neighbour, sample.kind == zenoh.SampleKind.PUT))
