"""What a vehicle tells its neighbours: its deviation from its own plan, stamped with its tick.

A message on the wire holds one sample or several of consecutive ticks. The layout of a sample, version 1, 40 bytes,
little-endian:

| offset | type | field |
|---|---|---|
| 0 | 2 bytes | "SK" |
| 2 | uint8 | version, 1 |
| 3 | uint8 | flags: bit 0, the vehicle flies its schedule and counts in the formation |
| 4 | uint32 | sysid |
| 8 | int64 | tick that the values are of |
| 16 | uint64 | sequence number, one more with each sample |
| 24 | float64 | e, metres along the path ahead of the schedule |
| 32 | float64 | e', m/s |
"""

import math
import struct
from typing import NamedTuple

VERSION = 1
_LAYOUT = struct.Struct("<2sBBIqQdd")
_IN_FORMATION = 1


class Correction(NamedTuple):
    """One vehicle's deviation at one tick."""

    sysid: int
    tick: int
    sequence: int
    in_formation: bool
    along_m: float
    along_rate_m_s: float


def encode(sample: Correction) -> bytes:
    """The sample's 40 bytes."""
    flags = _IN_FORMATION if sample.in_formation else 0
    return _LAYOUT.pack(
        b"SK", VERSION, flags, sample.sysid, sample.tick, sample.sequence, sample.along_m, sample.along_rate_m_s
    )


def decode(payload: bytes) -> list[Correction]:
    """The samples in a message.

    Raises:
        ValueError: it does not consist of samples of this version; the message is one of a few reasons.
    """
    if not payload or len(payload) % _LAYOUT.size:
        raise ValueError(f"length no multiple of {_LAYOUT.size} bytes")
    samples = []
    for magic, version, flags, sysid, tick, sequence, along, along_rate in _LAYOUT.iter_unpack(payload):
        if magic != b"SK":
            raise ValueError("not a correction")
        if version != VERSION:
            raise ValueError(f"not of version {VERSION}")
        if not (math.isfinite(along) and math.isfinite(along_rate)):
            raise ValueError("not finite")
        samples.append(Correction(sysid, tick, sequence, bool(flags & _IN_FORMATION), along, along_rate))
    return samples
