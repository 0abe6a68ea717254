"""MAVLink frames to messages and back, for one peer, whatever bytes come."""

import struct
from collections.abc import Callable
from operator import attrgetter

from fastcrc.crc16 import mcrf4xx
from pymavlink.dialects.v20 import ardupilotmega as mavlink

from sitl.services.peer import Message
from sitl.services.received import KINDS, MAGIC_V1, MAGIC_V2, SIGNATURE_BYTES, SIGNED, Kind, Received
from sitl.services.signing import Signer

_SHORTEST_V1, _SHORTEST_V2 = 8, 12
"""Header and checksum."""
_BY_WIRE_ID = {message_id.to_bytes(3, "little"): kind for message_id, kind in KINDS.items()}

_HEADER_V2 = struct.Struct("<7BHB")
_CHECKSUM = struct.Struct("<H")
_PLAIN = {
    message: (KINDS[message_id], attrgetter(*message.ordered_fieldnames))
    for message_id, message in mavlink.mavlink_map.items()
    if KINDS[message_id].plain and len(message.ordered_fieldnames) > 1
}
"""The messages whose fields are numbers, and what reads these in the order of the wire: they are packed here, to the
same bytes as by pymavlink in a quarter of its time. What is derived from such a message packs itself."""


class Codec:
    """Packs and parses the frames exchanged with one peer.

    Where a frame does not hold (checksum, flags, an id outside the dialect), the search for the next one starts one
    byte further on, so that garbage never swallows the frame behind it.

    Args:
        sysid, compid: the sender's ids put on packed frames.
        link_id: the link's number in signatures, 0 to 255.

    Attributes:
        skipped_bytes: bytes received so far that belonged to no frame of the dialect.
        damaged: how often something else than a frame stood where one was to start.
        unknown: how often what stood there may have been a frame of another dialect.
    """

    def __init__(self, sysid: int, compid: int, link_id: int = 0) -> None:
        self._mavlink = mavlink.MAVLink(None, srcSystem=sysid, srcComponent=compid)
        self._link_id = link_id
        self._rest = b""
        self._in_step = True
        self.skipped_bytes = 0
        self.damaged = 0
        self.unknown = 0

    def rename(self, sysid: int) -> None:
        """Put another system id on packed frames from now on."""
        self._mavlink.srcSystem = sysid

    def pack(self, message: Message, signing: Signer | None = None) -> bytes:
        """One MAVLink 2 frame, with this peer's next sequence number, signed where signing has a key."""
        plain = _PLAIN.get(type(message))
        frame = bytes(message.pack(self._mavlink)) if plain is None else self._pack(*plain, message)
        self._mavlink.seq = (self._mavlink.seq + 1) % 256
        return frame if signing is None else signing.sign(frame, self._link_id)

    def feed(self, data: bytes) -> list[Message]:
        """The messages that `data` completes, in order; their signatures are not looked at."""
        if self._rest:
            data = self._rest + data
        messages: list[Message] = []
        start, size = 0, len(data)
        while start < size:
            magic = data[start]
            if magic == MAGIC_V2 and size - start >= 3:
                flags = data[start + 2]
                end = start + _SHORTEST_V2 + data[start + 1]
                checksum_at = end - 2
                if flags:
                    end += SIGNATURE_BYTES
                    if flags != SIGNED:
                        start = self._skip(data, start)
                        continue
                if end > size:
                    break
                kind = _BY_WIRE_ID.get(data[start + 7 : start + 10])
            elif magic == MAGIC_V1 and size - start >= 3:
                end = start + _SHORTEST_V1 + data[start + 1]
                checksum_at = end - 2
                if end > size:
                    break
                kind = KINDS.get(data[start + 5])
            elif magic in (MAGIC_V1, MAGIC_V2):
                break
            else:
                start = self._skip(data, start)
                continue
            if kind is None:
                self.unknown += self._in_step
                start = self._skip(data, start, counted=True)
            elif mcrf4xx(data[start + 1 : checksum_at] + kind.checksum_extra) != (
                data[checksum_at] | data[checksum_at + 1] << 8
            ):
                start = self._skip(data, start)
            else:
                messages.append(Received(kind, data[start:end]))
                self._in_step = True
                start = end
        self._rest = data[start:]
        return messages

    def _pack(self, kind: Kind, values: Callable[[Message], tuple[float, ...]], message: Message) -> bytes:
        payload = kind.packed.pack(*values(message)).rstrip(b"\0") or b"\0"
        own, number = self._mavlink, kind.message_id
        header = _HEADER_V2.pack(
            MAGIC_V2, len(payload), 0, 0, own.seq, own.srcSystem, own.srcComponent, number & 0xFFFF, number >> 16
        )
        frame = header + payload
        return frame + _CHECKSUM.pack(mcrf4xx(frame[1:] + kind.checksum_extra))

    def _skip(self, data: bytes, start: int, *, counted: bool = False) -> int:
        """Where the next frame may start, after what starts here has turned out to be none."""
        self.damaged += self._in_step and not counted
        self._in_step = False
        found = [at for at in (data.find(MAGIC_V2, start + 1), data.find(MAGIC_V1, start + 1)) if at >= 0]
        next_start = min(found, default=len(data))
        self.skipped_bytes += next_start - start
        return next_start
