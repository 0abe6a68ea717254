"""Corrections over Zenoh: what a vehicle says and what it hears, tick by tick (DESIGN, Corrections over Zenoh)."""

import queue
import time
from collections.abc import Callable, Mapping
from functools import partial
from types import MappingProxyType

import zenoh

from sitl.formation.correction import Correction, decode, encode
from sitl.formation.door import Door
from sitl.formation.link_report import LinkReport
from sitl.zenoh_session import alive_key, correction_key, sysid_of

FAR_TICKS = 90_000
"""A sample that is an hour ahead is not believed. Who has just been started again may be well behind its neighbours."""


class Exchange:
    """Publishes the corrections of a process's vehicles and waits for those of their neighbours.

    In lockstep a vehicle at tick n waits for its neighbours' samples of an earlier tick. A neighbour whose liveliness
    token has gone is waited for no longer, until it is back. Neighbours in the process itself need no waiting for.

    Args:
        session: open; closed by its owner.
        swarm: part of every key.
        delays: of each vehicle of this process, the least delay in ticks of each neighbour that it listens to.
        last_ticks: of those who are to fall silent by schedule, the last tick that they tell of.

    Attributes:
        neighbours: those that are listened to in other processes.
        gone: vehicles of the swarm that have been there and are no more.
        on_gone: called when one has gone.
        inbox: what is to be done in the caller's thread; Zenoh's threads only put into it.
    """

    congestion = zenoh.CongestionControl.BLOCK

    def __init__(
        self,
        session: zenoh.Session,
        swarm: str,
        delays: Mapping[int, Mapping[int, int]],
        last_ticks: Mapping[int, int] = MappingProxyType({}),
    ) -> None:
        self.neighbours: tuple[int, ...] = ()
        self.gone: set[int] = set()
        self.on_gone: Callable[[], None] = lambda: None
        self.inbox: queue.SimpleQueue[Callable[[], None]] = queue.SimpleQueue()
        self._session = session
        self._swarm = swarm
        self._here = delays.keys()
        self._present: set[int] = set()
        self._stopped = False
        self._last_ticks = last_ticks
        self._delays: dict[int, dict[int, int]] = {}
        self._least: dict[int, int] = {}
        self._most: dict[int, int] = {}
        self._tick = 0
        self._samples: dict[int, dict[int, Correction]] = {}
        self._newest: dict[int, int] = {}
        self._unheard: set[int] = set()
        self._own: dict[int, Correction] = {}
        self._unsent: dict[int, list[bytes]] = {sysid: [] for sysid in delays}
        self._doors: dict[int, Door[Correction]] = {}
        self._publishers = {
            sysid: session.declare_publisher(
                correction_key(swarm, sysid),
                congestion_control=self.congestion,
                priority=zenoh.Priority.REAL_TIME,
                express=False,
            )
            for sysid in delays
        }
        for sysid, of in delays.items():
            self.listen(sysid, of)
        self._unheard.clear()
        session.liveliness().declare_subscriber(
            alive_key(swarm, "*"), zenoh.handlers.Callback(self._put_liveliness, indirect=False), history=True
        )

    def listen(self, sysid: int, delays: Mapping[int, int]) -> None:
        """Listen to the neighbours of a vehicle of this process, by sysid the least delay in ticks of each.

        One that is listened to only now has said things that were not heard: it is waited for as soon as it has been.
        """
        self._delays[sysid] = dict(delays)
        for neighbour, delay in delays.items():
            self._least[neighbour] = min(delay, self._least.get(neighbour, delay))
            self._most[neighbour] = max(delay, self._most.get(neighbour, delay))
            if neighbour in self._samples:
                continue
            self._samples[neighbour] = {}
            if neighbour not in self._here:
                self.neighbours = tuple(sorted((*self.neighbours, neighbour)))
                self._newest[neighbour] = -1
                self._unheard.add(neighbour)
                self._doors[neighbour] = Door(neighbour, decode, "Corrections")
                self._session.declare_subscriber(
                    correction_key(self._swarm, neighbour),
                    zenoh.handlers.Callback(self._sample_putter(neighbour), indirect=False),
                )

    def wait_for_neighbours(self, timeout_s: float) -> set[int]:
        """Wait until all neighbours are there; returns those that are not when the time is over."""
        deadline = time.monotonic() + timeout_s
        while missing := set(self.neighbours) - self._present:
            try:
                self.inbox.get(timeout=max(0.0, deadline - time.monotonic()))()
            except queue.Empty:
                return missing
            if self._stopped:
                return missing
        return set()

    def publish(self, sample: Correction, *, now: bool) -> None:
        """Tell the neighbours an own vehicle's deviation: now, or together with later ones in one message."""
        if (kept := self._samples.get(sample.sysid)) is not None:
            kept[sample.tick] = sample
        self._own[sample.sysid] = sample
        unsent = self._unsent[sample.sysid]
        unsent.append(encode(sample))
        if now:
            self._publishers[sample.sysid].put(b"".join(unsent))
            unsent.clear()

    def gather(self, tick: int) -> None:
        """Wait for all that is heard at a tick of neighbours that are there; no more once `stop` was called."""
        while (self.gone or self._unheard) and not self.inbox.empty():  # is someone back, or there at last?
            self.inbox.get()()
        self._tick = tick
        for neighbour in self.neighbours:
            if neighbour in self._unheard:
                continue
            needed = min(tick - self._least[neighbour], self._last_ticks.get(neighbour, tick))
            while self._newest[neighbour] < needed and neighbour not in self.gone and not self._stopped:
                self.inbox.get()()
        for sysid, samples in self._samples.items():
            samples.pop(tick - self._most[sysid] - 1, None)

    def wait_until(self, done: Callable[[], bool]) -> None:
        """Take in what comes until something is done; no more once `stop` was called."""
        while not done() and not self._stopped:
            self.inbox.get()()

    def heard_by(self, sysid: int) -> dict[int, Correction]:
        """What comes to one of the process's vehicles at the tick gathered for: by neighbour, its sample of as many
        ticks ago as that link delays it at least."""
        heard = {}
        for neighbour, delay in self._delays[sysid].items():
            sample = self._samples[neighbour].get(self._tick - delay)
            if sample is not None:
                heard[neighbour] = sample
        return heard

    def complaints(self, sysid: int) -> list[str]:
        """What is new of what was refused of the neighbours of a vehicle of this process, for people, a line each."""
        doors = [self._doors[other] for other in self._delays[sysid] if other in self._doors]
        return [line for door in doors for line in door.complaints()]

    def reports(self, sysid: int) -> tuple[LinkReport, ...]:
        """What came of the links to a vehicle of this process."""
        return tuple(LinkReport(other, sysid, self._refused(other)) for other in sorted(self._delays[sysid]))

    def stop(self) -> None:
        """Wake a waiting `gather`, from any thread; it waits no more."""
        self.inbox.put(self._note_stop)

    def _note_stop(self) -> None:
        self._stopped = True

    def _note_present(self, sysid: int) -> None:
        self._present.add(sysid)
        if sysid in self.gone:
            self.gone.discard(sysid)
            if sysid in self._doors:
                self._doors[sysid].reopen()
            self._greet()

    def _note_gone(self, sysid: int) -> None:
        self._present.discard(sysid)
        self.gone.add(sysid)
        self.on_gone()

    def _greet(self) -> None:
        """Say the newest again, to a neighbour that is back: it waits for us from now on, as we do for it."""
        for sysid, sample in self._own.items():
            self._publishers[sysid].put(encode(sample))

    def _take_samples(self, neighbour: int, payload: bytes) -> None:
        for sample in self._doors[neighbour].admit(payload, self._tick + FAR_TICKS):
            self._unheard.discard(neighbour)
            if sample.tick >= self._tick - self._most[neighbour]:  # one who is back may have to catch up
                self._samples[neighbour][sample.tick] = sample
            self._newest[neighbour] = max(self._newest[neighbour], sample.tick)

    def _refused(self, neighbour: int) -> dict[str, int]:
        return dict(self._doors[neighbour].refused) if neighbour in self._doors else {}

    def _sample_putter(self, neighbour: int) -> Callable[[zenoh.Sample], None]:
        return lambda sample: self.inbox.put(partial(self._take_samples, neighbour, sample.payload.to_bytes()))

    def _put_liveliness(self, sample: zenoh.Sample) -> None:
        sysid = sysid_of(str(sample.key_expr), self._swarm)
        if sysid not in self._here:
            note = self._note_present if sample.kind == zenoh.SampleKind.PUT else self._note_gone
            self.inbox.put(partial(note, sysid))
