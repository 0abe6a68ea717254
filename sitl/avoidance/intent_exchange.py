"""Intents over Zenoh: all vehicles tell all others, once a second."""

import queue
import time
from collections.abc import Callable, Iterable, Mapping
from functools import partial

import zenoh

from sitl.avoidance.intent import PERIOD_TICKS, Intent, decode, encode
from sitl.formation.door import Door
from sitl.formation.exchange import FAR_TICKS
from sitl.formation.link_report import LinkReport
from sitl.formation.network import Network
from sitl.zenoh_session import alive_key, intent_key, sysid_of


class IntentExchange:
    """Publishes the intents of a process's vehicles and takes in those of all others of the swarm.

    In lockstep a vehicle waits, at the ticks at which intents are told, for those that have had the time of their
    link's least delay; whose liveliness token has gone is waited for no longer. In real time nobody waits.

    Args:
        session: open; closed by its owner.
        swarm: part of every key.
        here: the process's vehicles.
        network: of the swarm.
        now_ticks: in real time, the clock of all in ticks; None in lockstep.
    """

    def __init__(
        self,
        session: zenoh.Session,
        swarm: str,
        here: Iterable[int],
        network: Network,
        now_ticks: Callable[[], float] | None = None,
    ) -> None:
        self._swarm = swarm
        self._here = frozenset(here)
        self._network = network
        self._now_ticks = now_ticks
        self._others = tuple(sysid for sysid in network.sysids if sysid not in self._here)
        self._least = {
            other: min(network.channel_of(other, sysid).delay_ticks for sysid in self._here) for other in self._others
        }
        self._doors = {other: Door(other, decode, "Intents") for other in self._others}
        self._newest = dict.fromkeys(self._others, -1)
        self._present: set[int] = set()
        self._gone: set[int] = set()
        self._stopped = False
        self._tick = 0
        self._own: dict[int, Intent] = {}
        self._came: dict[int, dict[int, list[tuple[Intent, int]]]] = {sysid: {} for sysid in self._here}
        # As in `Exchange`: Zenoh's threads only put into the inbox what is to be done in the caller's thread.
        self._inbox: queue.SimpleQueue[Callable[[], None]] = queue.SimpleQueue()
        block, drop = zenoh.CongestionControl.BLOCK, zenoh.CongestionControl.DROP
        self._publishers = {
            sysid: session.declare_publisher(
                intent_key(swarm, sysid),
                congestion_control=block if now_ticks is None else drop,
                priority=zenoh.Priority.REAL_TIME,
                express=False,
            )
            for sysid in self._here
        }
        for other in self._others:
            session.declare_subscriber(
                intent_key(swarm, other), zenoh.handlers.Callback(self._putter(other), indirect=False)
            )
        session.liveliness().declare_subscriber(
            alive_key(swarm, "*"), zenoh.handlers.Callback(self._put_liveliness, indirect=False), history=True
        )

    def wait_for_others(self, timeout_s: float) -> set[int]:
        """Wait until all others are there; returns those that are not in time, who are taken to be gone."""
        deadline = time.monotonic() + timeout_s
        while missing := set(self._others) - self._present:
            try:
                self._inbox.get(timeout=max(0.0, deadline - time.monotonic()))()
            except queue.Empty:
                self._gone |= missing
                return missing
            if self._stopped:
                return missing
        return set()

    def publish(self, intent: Intent) -> None:
        """Tell all others what an own vehicle intends."""
        self._own[intent.sysid] = intent
        self._publishers[intent.sysid].put(encode(intent))
        self._deliver(intent, 0)

    def gather(self, tick: int) -> None:
        """Wait for all that counts at a tick of those who are there; no more once `stop` was called."""
        self._tick = tick
        while not self._inbox.empty():
            self._inbox.get()()
        if self._now_ticks is not None:
            return
        for other in self._others:
            last = self._network.deaths.get(other, tick + 1) - 1
            needed = min(tick - self._least[other], last) // PERIOD_TICKS * PERIOD_TICKS
            while self._newest[other] < needed and other not in self._gone and not self._stopped:
                self._inbox.get()()

    def take(self, sysid: int) -> Mapping[int, Iterable[tuple[Intent, int]]]:
        """What has come for one of the process's vehicles since it was last asked: by sender, intents, and the whole
        ticks that each took; in lockstep none."""
        came, self._came[sysid] = self._came[sysid], {}
        return came

    def complaints(self) -> list[str]:
        """What is new of what was refused, for people, a line each."""
        return [line for door in self._doors.values() for line in door.complaints()]

    def reports(self, sysid: int) -> tuple[LinkReport, ...]:
        """To a vehicle of this process, the links from which messages were refused."""
        refused = {other: dict(door.refused) for other, door in self._doors.items()}
        return tuple(LinkReport(other, sysid, reasons) for other, reasons in refused.items() if reasons)

    def stop(self) -> None:
        """Wake a waiting `gather`, from any thread; it waits no more."""
        self._inbox.put(self._note_stop)

    def _note_stop(self) -> None:
        self._stopped = True

    def _deliver(self, intent: Intent, took_ticks: int) -> None:
        for sysid, came in self._came.items():
            if sysid != intent.sysid:
                came.setdefault(intent.sysid, []).append((intent, took_ticks))

    def _take_in(self, other: int, payload: bytes, now_ticks: float | None) -> None:
        for intent in self._doors[other].admit(payload, self._tick + FAR_TICKS):
            self._newest[other] = max(self._newest[other], intent.tick)
            self._deliver(intent, 0 if now_ticks is None else max(0, int(now_ticks) - intent.tick))

    def _putter(self, other: int) -> Callable[[zenoh.Sample], None]:
        def put(sample: zenoh.Sample) -> None:
            now_ticks = self._now_ticks() if self._now_ticks else None
            self._inbox.put(partial(self._take_in, other, sample.payload.to_bytes(), now_ticks))

        return put

    def _note_present(self, sysid: int) -> None:
        self._present.add(sysid)
        if sysid in self._gone:
            self._gone.discard(sysid)
            self._doors[sysid].reopen()
            for own, intent in self._own.items():  # it waits for us from now on, as we do for it
                self._publishers[own].put(encode(intent))

    def _note_gone(self, sysid: int) -> None:
        self._present.discard(sysid)
        self._gone.add(sysid)

    def _put_liveliness(self, sample: zenoh.Sample) -> None:
        sysid = sysid_of(str(sample.key_expr), self._swarm)
        if sysid in self._doors:
            note = self._note_present if sample.kind == zenoh.SampleKind.PUT else self._note_gone
            self._inbox.put(partial(note, sysid))
