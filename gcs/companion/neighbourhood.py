"""What companions tell each other over Zenoh: the corrections of `sitl.formation.correction`, as endpoints do."""

import threading
from collections.abc import Callable, Iterable

import zenoh

from sitl.formation.correction import Correction, decode, encode
from sitl.formation.door import Door
from sitl.zenoh_session import alive_key, correction_key, sysid_of

LATEST_TICK = 2**40
"""Vehicles' clocks are their own: no sample is refused for being ahead."""


class Neighbourhood:
    """Says one vehicle's deviations and keeps the newest of its neighbours'.

    Args:
        session: open; closed by its owner.
        swarm: part of every key.
        slot: whose deviations are said.
        neighbours: who is listened to.
    """

    def __init__(self, session: zenoh.Session, swarm: str, slot: int, neighbours: Iterable[int]) -> None:
        self._doors = {other: Door(other, decode, "Corrections") for other in neighbours}
        self._newest: dict[int, Correction] = {}
        self._swarm = swarm
        self._lock = threading.Lock()
        self._publisher = session.declare_publisher(
            correction_key(swarm, slot),
            congestion_control=zenoh.CongestionControl.DROP,
            priority=zenoh.Priority.REAL_TIME,
        )
        self._token = session.liveliness().declare_token(alive_key(swarm, slot))
        session.liveliness().declare_subscriber(
            alive_key(swarm, "*"), zenoh.handlers.Callback(self._note_life, indirect=False), history=True
        )
        for other in self._doors:
            listener = zenoh.handlers.Callback(self._listener(other), indirect=False)
            session.declare_subscriber(correction_key(swarm, other), listener)

    def say(self, sample: Correction) -> None:
        """Tell the neighbours."""
        self._publisher.put(encode(sample))

    def heard(self) -> dict[int, Correction]:
        """The newest of each neighbour that has said something."""
        with self._lock:
            return dict(self._newest)

    def complaints(self) -> list[str]:
        """What is new of what was refused, for people, a line each."""
        with self._lock:
            return [line for door in self._doors.values() for line in door.complaints()]

    def _note_life(self, sample: zenoh.Sample) -> None:
        """Who goes says nothing more; who comes may begin anew."""
        slot = sysid_of(str(sample.key_expr), self._swarm)
        with self._lock:
            self._newest.pop(slot, None)
            if slot in self._doors:
                self._doors[slot].reopen()

    def _listener(self, other: int) -> Callable[[zenoh.Sample], None]:
        """What takes in what comes in the name of a neighbour."""

        def take(sample: zenoh.Sample) -> None:
            payload = sample.payload.to_bytes()
            with self._lock:
                samples = self._doors[other].admit(payload, LATEST_TICK)
                if samples:
                    self._newest[other] = samples[-1]

        return take
