"""What a vehicle tells its neighbours: its deviation from its own plan, stamped with its tick.

A message on the wire holds one sample or several of consecutive ticks. The layout of a sample, version 2, 72 bytes,
little-endian:

| offset | type | field |
|---|---|---|
| 0 | 2 bytes | "SK" |
| 2 | uint8 | version, 2 |
| 3 | uint8 | flags: bit 0, the vehicle flies its schedule and counts in the formation |
| 4 | uint32 | sysid |
| 8 | int64 | tick that the values are of |
| 16 | uint64 | sequence number, one more with each sample |
| 24 | float64 | e, metres along the path ahead of the schedule |
| 32 | float64 | e', m/s |
| 40 | float64 | what its schedule has been slowed since the launch, seconds (see `swarm_clock`) |
| 48 | float64 | the rate at which that grows, s/s |
| 56 | float64 | what it has been hurried, seconds |
| 64 | float64 | the rate at which that grows, s/s |
"""

import math
import struct
from typing import NamedTuple

VERSION = 2
_LAYOUT = struct.Struct("<2sBBIqQ6d")
_IN_FORMATION = 1


class Correction(NamedTuple):
    """One vehicle's deviation at one tick."""

    sysid: int
    tick: int
    sequence: int
    in_formation: bool
    along_m: float
    along_rate_m_s: float
    slowed_s: float = 0.0
    slowed_rate: float = 0.0
    hurried_s: float = 0.0
    hurried_rate: float = 0.0


def encode(sample: Correction) -> bytes:
    """The sample's 72 bytes."""
    flags = _IN_FORMATION if sample.in_formation else 0
    return _LAYOUT.pack(
        b"SK",
        VERSION,
        flags,
        sample.sysid,
        sample.tick,
        sample.sequence,
        sample.along_m,
        sample.along_rate_m_s,
        sample.slowed_s,
        sample.slowed_rate,
        sample.hurried_s,
        sample.hurried_rate,
    )


def decode(payload: bytes) -> list[Correction]:
    """The samples in a message.

    Raises:
        ValueError: it does not consist of samples of this version; the message is one of a few reasons.
    """
    if not payload or len(payload) % _LAYOUT.size:
        raise ValueError(f"length no multiple of {_LAYOUT.size} bytes")
    samples = []
    for magic, version, flags, sysid, tick, sequence, *values in _LAYOUT.iter_unpack(payload):
        if magic != b"SK":
            raise ValueError("not a correction")
        if version != VERSION:
            raise ValueError(f"not of version {VERSION}")
        if not all(map(math.isfinite, values)):
            raise ValueError("not finite")
        samples.append(Correction(sysid, tick, sequence, bool(flags & _IN_FORMATION), *values))
    return samples
