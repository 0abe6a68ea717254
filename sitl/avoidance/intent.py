"""What a vehicle tells all others once a second: where it will be.

The layout of a message, version 1, little-endian, 32 bytes and 24 for each point:

| offset | type | field |
|---|---|---|
| 0 | 2 bytes | "SI" |
| 2 | uint8 | version, 1 |
| 3 | uint8 | status, of those below |
| 4 | uint32 | sysid |
| 8 | int64 | tick that it is of, a multiple of 25 |
| 16 | uint64 | sequence number, tick / 25 |
| 24 | float64 | pace of one who falls silent since it hangs, and just holds its airspeed: in shares of what it tells |
| 32 | 3 float64 each | x, y, z in metres, local frame: now, and every 3 s from then on; at most 41 points |
"""

import math
import struct
from typing import NamedTuple

VERSION = 1
PERIOD_TICKS = 25
"""From one intent to the next: a second."""
STEP_S = 3.0
"""From one predicted place to the next."""
AHEAD, POINTS = 21, 41
"""So far is looked ahead, 60 s; and so far is told, 120 s, for one who falls silent."""
SLOWEST, FASTEST = 0.5, 1.5
"""Bounds of the pace of one who hangs."""
FARTHEST_M = 1e7
"""No coordinate is larger."""

QUIET, GROUNDED, YIELDS, KEEPS = range(4)
"""Statuses. QUIET tells nothing: what was told before is all there is. GROUNDED: nobody to avoid, on the ground or on
the circle where the mission ends, whose altitudes are planned. YIELDS: flies its mission, and can give way. KEEPS: does
not."""

_HEAD = struct.Struct("<2sBBIqQd")
_POINT = struct.Struct("<ddd")

Point = tuple[float, float, float]


class Intent(NamedTuple):
    """Where one vehicle will be, as of one tick."""

    sysid: int
    tick: int
    sequence: int
    status: int
    alone: float
    points: tuple[Point, ...]


def intent_at(sysid: int, tick: int, status: int, points: tuple[Point, ...] = (), alone: float = 1.0) -> Intent:
    """The intent of a tick at which one is told."""
    return Intent(sysid, tick, tick // PERIOD_TICKS, status, alone, points)


def encode(intent: Intent) -> bytes:
    """The message of an intent."""
    head = _HEAD.pack(b"SI", VERSION, intent.status, intent.sysid, intent.tick, intent.sequence, intent.alone)
    return head + b"".join(_POINT.pack(*point) for point in intent.points)


def decode(payload: bytes) -> list[Intent]:
    """The one intent in a message.

    Raises:
        ValueError: it is no intent of this version; the message is one of a few reasons.
    """
    count, rest = divmod(len(payload) - _HEAD.size, _POINT.size)
    if rest or not 0 <= count <= POINTS:
        raise ValueError(f"length not of at most {POINTS} points")
    magic, version, status, sysid, tick, sequence, alone = _HEAD.unpack_from(payload)
    if magic != b"SI":
        raise ValueError("not an intent")
    if version != VERSION:
        raise ValueError(f"not of version {VERSION}")
    if status > KEEPS:
        raise ValueError("no such status")
    if tick != sequence * PERIOD_TICKS:
        raise ValueError("sequence out of step with time")
    if not SLOWEST <= alone <= FASTEST:
        raise ValueError("no such pace")
    points = tuple(_POINT.iter_unpack(payload[_HEAD.size :]))
    if not all(math.isfinite(value) and abs(value) <= FARTHEST_M for point in points for value in point):
        raise ValueError("not a place")
    return [Intent(sysid, tick, sequence, status, alone, points)]
