"""One vehicle as the station knows it: what it said last, and a way to answer."""

import asyncio
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TypeAlias

from gcs.status_lines import StatusLines
from gcs.tlog import TelemetryLog
from gcs.transfers.acquaintance import Acquaintance
from missions.autopilot import Autopilot
from sitl.services.peer import Message, Peer
from sitl.services.received import MAGIC_V2, SIGNED
from sitl.services.signing import Signer, Signing

OnMessage: TypeAlias = Callable[[Message], None]
SILENCE_S = 3.0
"""A vehicle that has not been heard for so long is not there: three heartbeats are lost."""


class VehicleLink:
    """One vehicle on a link.

    Args:
        sysid, compid: its MAVLink ids.
        peer: where it is.
        send_message: packs and sends a message to it, and returns the frame.
        log: where its traffic is recorded; the keys that it is given are not.
        signing: see below; None for no key.

    Attributes:
        latest: the newest message of each type.
        signing: the key that it shares with the station, if any.
        found_at_s: when it was first heard, `time.monotonic` seconds.
        heard_at_s: when it was last heard, `time.monotonic` seconds.
        simulated_ms: its newest time_boot_ms.
        frames: how many have come.
        lost_frames: frames missing from its sequence numbers.
        texts: its STATUSTEXT lines, oldest first.
        known: what transfers have learned of it and the link to it.
        transfer_lock: held by the one transfer there may be at a time.
        command_lock: held by the one command there may be at a time.
    """

    def __init__(
        self,
        sysid: int,
        compid: int,
        peer: Peer,
        send_message: Callable[[Message], bytes],
        log: TelemetryLog | None = None,
        signing: Signer | None = None,
    ) -> None:
        self.sysid = sysid
        self.compid = compid
        self.peer = peer
        self.latest: dict[str, Message] = {}
        self.signing: Signer = signing or Signing()
        self.found_at_s = self.heard_at_s = time.monotonic()
        self.simulated_ms = 0
        self.frames = 0
        self.lost_frames = 0
        self.texts: list[str] = []
        self.known = Acquaintance()
        self.transfer_lock = asyncio.Lock()
        self.command_lock = asyncio.Lock()
        self._send_message = send_message
        self._log = log
        self._next_seq: int | None = None
        self._first_ms: int | None = None
        self._listeners: list[OnMessage] = []
        self._status_lines = StatusLines()

    def __str__(self) -> str:
        return f"vehicle {self.sysid}"

    def send(self, message: Message) -> None:
        """Send one message to the vehicle."""
        frame = self._send_message(message)
        if self._log is not None and message.get_type() != "SETUP_SIGNING":
            self._log.write(self.simulated_ms, frame)

    @contextmanager
    def listening(self, on_message: OnMessage) -> Iterator[None]:
        """Within this context, `on_message` gets every message from the vehicle as it comes."""
        self._listeners.append(on_message)
        try:
            yield
        finally:
            self._listeners.remove(on_message)

    def move_to(self, peer: Peer, send_message: Callable[[Message], bytes]) -> None:
        """The vehicle has come back at another address."""
        self.peer = peer
        self._send_message = send_message
        self._next_seq = None

    @property
    def silent_s(self) -> float:
        """How long nothing has been heard of it."""
        return time.monotonic() - self.heard_at_s

    @property
    def heard(self) -> bool:
        """Whether it is there: a vehicle sends a heartbeat each second."""
        return self.silent_s < SILENCE_S

    @property
    def signs(self) -> bool:
        """Whether its last heartbeat was signed."""
        heartbeat = self.latest.get("HEARTBEAT")
        frame = heartbeat.get_msgbuf() if heartbeat is not None else bytes(3)
        return bool(frame[0] == MAGIC_V2 and frame[2] & SIGNED)

    @property
    def autopilot(self) -> Autopilot:
        """Whose dialect it speaks, by its heartbeat: ArduPilot's, unless it is a PX4."""
        heartbeat = self.latest.get("HEARTBEAT")
        px4 = heartbeat is not None and heartbeat.autopilot == Autopilot.px4.mav_autopilot
        return Autopilot.px4 if px4 else Autopilot.ardupilot

    @property
    def pace(self) -> float:
        """Its simulated seconds a second, on the average since it was found."""
        passed_s = self.heard_at_s - self.found_at_s
        if self._first_ms is None or passed_s <= 0.0:
            return 1.0
        return (self.simulated_ms - self._first_ms) / 1000.0 / passed_s

    def on_message(self, message: Message) -> None:
        """Take one message from the vehicle."""
        self.heard_at_s = time.monotonic()
        self.frames += 1
        kind = message.get_type()
        time_ms = message.time_boot_ms_or(0)
        if time_ms > self.simulated_ms:
            self.simulated_ms = time_ms
            if self._first_ms is None:
                self._first_ms = time_ms
        self._count_lost(message.get_seq())
        self.latest[kind] = message
        if self._log is not None:
            self._log.write(self.simulated_ms, message.get_msgbuf())
        if kind == "STATUSTEXT":
            self.texts.extend(self._status_lines.feed(message))
        if self._listeners:
            for listener in list(self._listeners):
                listener(message)

    def _count_lost(self, seq: int) -> None:
        if self._next_seq is not None:
            self.lost_frames += (seq - self._next_seq) % 256
        self._next_seq = (seq + 1) % 256
