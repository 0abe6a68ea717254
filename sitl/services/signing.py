"""MAVLink 2 signing: one end's key, its timestamps, and what it accepts. Both ends use it.

A frame's signature is the link's id, 48 bits of time in units of 10 us since 2015, and the first 48 bits of the SHA-256
of key, frame, link and time. With a key only properly signed frames are accepted; RADIO_STATUS, for which the MAVLink
guide leaves a choice, is no exception.
"""

import hashlib
import hmac
import time
from collections.abc import Callable
from enum import Enum
from typing import Protocol

from fastcrc.crc16 import mcrf4xx

from missions.errors import InputError
from sitl.services.received import HEADER_V2_BYTES, KINDS, MAGIC_V2, SIGNATURE_BYTES, SIGNED
from sitl.store import Store

KEY_BYTES = 32
NO_KEY = bytes(KEY_BYTES)
TICKS_PER_S = 100_000
EPOCH_S = 1_420_070_400
"""2015-01-01, Unix time."""
LONGEST_LAG = 60 * TICKS_PER_S
"""The first frame of a stream may be so far behind the newest time known (MAVLink guide: one minute)."""
LATEST = 2**48 - 1
_RESERVED = 10 * TICKS_PER_S
"""Timestamps are reserved in the store so far ahead, that none is used twice over a restart."""
_FARTHEST_START = 366 * 24 * 3600 * TICKS_PER_S
_PIECE = "signing"

_Stream = tuple[int, int, int]
"""Link id, system id and component id."""


class Verdict(Enum):
    """What signing says of a frame."""

    GOOD = "good"
    UNSIGNED = "unsigned"
    WRONG = "wrongly signed"
    OLD = "signed too long ago"


class Signer(Protocol):
    """What links ask."""

    def sign(self, frame: bytes, link_id: int) -> bytes:
        """A frame to be sent, signed if need be."""

    def judge(self, frame: bytes) -> Verdict:
        """Whether a frame that came may have an effect."""


class Signing:
    """The key of one end of a network and what goes with it; all of its links share it.

    Without a key everything is accepted and nothing signed.

    Args:
        store: keeps the key and the time reached over restarts.
        key: 32 bytes, in place of the one kept; None for the one kept, or none until one is set.
        now: Unix time in seconds.

    Attributes:
        trouble: why the time reached could not be kept, last time; None when nothing has gone wrong.

    Raises:
        InputError: what the store has is damaged or cannot be written.
    """

    def __init__(
        self, store: Store | None = None, key: bytes | None = None, now: Callable[[], float] = time.time
    ) -> None:
        self._store = store or Store()
        self._now = now
        self._key: bytes | None = None
        self._last_sent = 0
        self._reserved = 0
        self._newest_heard = 0
        self.trouble: str | None = None
        self._streams: dict[_Stream, int] = {}
        kept = self._store.read(_PIECE)
        if kept is not None:
            timestamp = int.from_bytes(kept[KEY_BYTES:], "big")
            self._start(None if kept[:KEY_BYTES] == NO_KEY else kept[:KEY_BYTES], timestamp)
        if key is not None and key != self._key:
            self.set_key(key, 0)

    @property
    def key(self) -> bytes | None:
        """The secret; None when there is none."""
        return self._key

    def set_key(self, key: bytes | None, timestamp: int) -> None:
        """Sign with this key from now on, or stop signing, and keep that.

        Args:
            key: 32 bytes, not all zero; None for no signing.
            timestamp: no earlier one is used for sending.

        Raises:
            InputError: it is no key, or leaves no time, or could not be kept; the old key stays.
        """
        if key is not None and (len(key) != KEY_BYTES or key == NO_KEY):
            raise InputError(f"a signing key has {KEY_BYTES} bytes, not all of them zero")
        if timestamp - self._clock() > _FARTHEST_START:
            raise InputError("the initial timestamp is more than a year ahead; set the clock of the station")
        first = max(timestamp, self._last_sent, self._clock())
        self._keep(key, first + _RESERVED)
        self._start(key, first)
        self._reserved = first + _RESERVED

    def sign(self, frame: bytes, link_id: int) -> bytes:
        """A complete unsigned MAVLink 2 frame, signed; the frame itself when there is no key."""
        if self._key is None:
            return frame
        timestamp = min(LATEST, max(self._last_sent + 1, self._newest_heard, self._clock()))
        if timestamp >= self._reserved:
            self._reserved = timestamp + _RESERVED
            try:
                self._keep(self._key, self._reserved)
            except InputError as error:  # a full disk is no reason to fall silent in flight
                self.trouble = f"signing time not kept: {error}"
        self._last_sent = timestamp
        return signed(frame, self._key, link_id, timestamp)

    def judge(self, frame: bytes) -> Verdict:
        """Whether a frame, its checksum being right, may have an effect; a good one is good only once."""
        if self._key is None:
            return Verdict.GOOD
        if frame[0] != MAGIC_V2 or not frame[2] & SIGNED:
            return Verdict.UNSIGNED
        if not hmac.compare_digest(_digest(self._key, frame[:-6]), frame[-6:]):
            return Verdict.WRONG
        timestamp = int.from_bytes(frame[-12:-6], "little")
        stream = (frame[-SIGNATURE_BYTES], frame[5], frame[6])
        last = self._streams.get(stream)
        # The own clock counts here, not the time reserved ahead: a restart is to lock out nobody.
        earliest = max(self._clock(), self._newest_heard) - LONGEST_LAG if last is None else last + 1
        if timestamp < earliest:
            return Verdict.OLD
        self._streams[stream] = timestamp
        self._newest_heard = max(self._newest_heard, timestamp)
        return Verdict.GOOD

    @staticmethod
    def timestamp_at(time_s: float) -> int:
        """The timestamp of a Unix time."""
        return max(0, round((time_s - EPOCH_S) * TICKS_PER_S))

    def _start(self, key: bytes | None, timestamp: int) -> None:
        self._key = key
        self._last_sent = timestamp
        self._newest_heard = 0
        self._streams = {}

    def _keep(self, key: bytes | None, timestamp: int) -> None:
        self._store.write(_PIECE, (key or NO_KEY) + timestamp.to_bytes(8, "big"))

    def _clock(self) -> int:
        return self.timestamp_at(self._now())


def signed(frame: bytes, key: bytes, link_id: int, timestamp: int) -> bytes:
    """A complete unsigned MAVLink 2 frame, signed at a time."""
    body = bytearray(frame[:-2])
    body[2] |= SIGNED
    extra = KINDS[int.from_bytes(body[7:HEADER_V2_BYTES], "little")].checksum_extra
    body += mcrf4xx(bytes(body[1:]) + extra).to_bytes(2, "little")
    body += bytes([link_id]) + timestamp.to_bytes(6, "little")
    return bytes(body) + _digest(key, bytes(body))


def _digest(key: bytes, signed_bytes: bytes) -> bytes:
    return hashlib.sha256(key + signed_bytes).digest()[:6]
