"""Bytes that nobody should send: noise, and frames of every message with any fields, whole, cut, damaged, repeated."""

import random
from collections.abc import Iterator

from fastcrc.crc16 import mcrf4xx

from sitl.services.received import KINDS, MAGIC_V1, MAGIC_V2, Kind
from sitl.services.signing import Signing, signed

_REPEATED = 64
"""So many pieces back something may be sent again."""
_LEFT_OUT = "SETUP_SIGNING"
"""Once it had a key the receiver would hear nothing any more."""
_EDGES = (bytes(4), b"\xff" * 4, b"\x00\x00\xc0\x7f", b"\x00\x00\x80\x7f", b"\x00\x00\x80\xff")
"""Zero, all ones, NaN and the infinities."""


def hostile_traffic(seed: int, target: tuple[int, int], sysids: range) -> Iterator[bytes]:
    """Pieces as they come from a socket, without end; the same for the same seed.

    Args:
        seed: of all that is random.
        target: system and component that half of the messages with a target are for.
        sysids: of the senders.
    """
    rng = random.Random(seed)
    kinds = [kind for kind in KINDS.values() if kind.name != _LEFT_OUT]
    aimed = [(kind, _offsets(kind)) for kind in kinds if "target_system" in kind.names]
    past = [b""]
    while True:
        if rng.random() < 0.5:
            kind, offsets = rng.choice(aimed)
        else:
            kind, offsets = rng.choice(kinds), {}
        payload = _payload(kind, rng)
        for name, at in offsets.items():
            if rng.random() < 0.9:
                payload[at] = target[0] if name == "target_system" else target[1]
        piece = _frame(kind, bytes(payload), rng, rng.choice(sysids))
        match rng.randrange(12):
            case 0:
                piece = rng.randbytes(rng.randrange(300))
            case 1:
                piece = piece[: rng.randrange(len(piece))]
            case 2:
                damaged = bytearray(piece)
                damaged[rng.randrange(len(damaged))] ^= 1 << rng.randrange(8)
                piece = bytes(damaged)
            case 3:
                piece = rng.choice(past)
            case 4:
                piece = b"".join(rng.sample(past, min(5, len(past)))) + piece
            case 5 if piece[0] == MAGIC_V2:
                piece = signed(piece, rng.randbytes(32), rng.randrange(256), Signing.timestamp_at(1.8e9))
        past = [*past[1 - _REPEATED :], piece]
        yield piece


def _payload(kind: Kind, rng: random.Random) -> bytearray:
    payload = bytearray(rng.randbytes(kind.packed.size))
    for at in range(0, len(payload) - 3, 4):
        if rng.random() < 0.3:
            payload[at : at + 4] = rng.choice(_EDGES)
    return payload


def _frame(kind: Kind, payload: bytes, rng: random.Random, sysid: int) -> bytes:
    seq, compid = rng.randrange(256), rng.choice((1, 190, rng.randrange(256)))
    if kind.message_id < 256 and rng.random() < 0.1:
        body = bytes([len(payload), seq, sysid, compid, kind.message_id]) + payload
        start = bytes([MAGIC_V1])
    else:
        payload = payload.rstrip(b"\0") or b"\0"
        body = bytes([len(payload), 0, 0, seq, sysid, compid]) + kind.message_id.to_bytes(3, "little") + payload
        start = bytes([MAGIC_V2])
    return start + body + mcrf4xx(body + kind.checksum_extra).to_bytes(2, "little")


def _offsets(kind: Kind) -> dict[str, int]:
    """Where in the payload the target is."""
    offsets = {}
    for name, place, _ in kind.fields:
        if name in ("target_system", "target_component"):
            values = list(kind.packed.unpack(bytes(kind.packed.size)))
            values[place] = 1
            offsets[name] = kind.packed.pack(*values).index(1)
    return offsets
