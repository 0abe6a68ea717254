"""A message as it came over a link: its fields are decoded when the first of them is asked for.

Most of what a station receives is never read but for the newest of its type; finding and checking a frame costs a
microsecond, decoding it several. The layouts are pymavlink's, for every message of its dialect.
"""

import struct
from dataclasses import dataclass

from pymavlink.dialects.v20 import ardupilotmega as mavlink

from sitl.services.mode_messages import MODE_MESSAGES
from sitl.services.peer import Message

MAGIC_V1, MAGIC_V2 = 0xFE, 0xFD
SIGNED = 0x01
"""The one incompatibility flag there is: a signature follows the checksum."""
SIGNATURE_BYTES = 13
HEADER_V1_BYTES, HEADER_V2_BYTES = 6, 10


@dataclass(frozen=True, slots=True)
class Kind:
    """The layout of one message.

    Attributes:
        message_id: its number.
        name: as `get_type` has it.
        checksum_extra: the byte that goes into the checksum behind the frame.
        packed: the payload at full length.
        fields: (name, place among the unpacked values, number of values), in the order of the wire.
        names: of the fields.
        plain: whether each field is one number.
        time_at: where in the payload time_boot_ms is; None when it has none.
    """

    message_id: int
    name: str
    checksum_extra: bytes
    packed: struct.Struct
    fields: tuple[tuple[str, int, int], ...]
    names: tuple[str, ...]
    plain: bool
    time_at: int | None

    def decode(self, payload: bytes) -> dict[str, object]:
        """The fields of a payload, of which trailing zeros may be missing and unknown extensions may follow."""
        size = self.packed.size
        values = self.packed.unpack(payload[:size] if len(payload) >= size else payload.ljust(size, b"\0"))
        if self.plain:
            return dict(zip(self.names, values, strict=True))
        return {name: _field(values, at, count) for name, at, count in self.fields}


def _field(values: tuple[object, ...], at: int, count: int) -> object:
    value = values[at]
    if isinstance(value, bytes):
        return value.split(b"\0", 1)[0].decode("ascii", "replace")
    return value if count == 1 else list(values[at : at + count])


def _kind(message: Message) -> Kind:
    fields, place = [], 0
    time_at = None
    for name, count in zip(message.ordered_fieldnames, message.lengths, strict=True):
        if name == "time_boot_ms":
            before = message.unpacker.format[: 1 + place]  # wire order is largest first: no array precedes it
            time_at = struct.calcsize(before)
        fields.append((name, place, count))
        place += count
    return Kind(
        message_id=message.id,
        name=message.msgname,
        checksum_extra=bytes([message.crc_extra]),
        packed=message.unpacker,
        fields=tuple(fields),
        names=tuple(message.ordered_fieldnames),
        plain=len(fields) == place and b"s" not in message.unpacker.format.encode(),
        time_at=time_at,
    )


KINDS: dict[int, Kind] = {
    message_id: _kind(message) for message_id, message in (mavlink.mavlink_map | MODE_MESSAGES).items()
}
"""Every message of the dialect, and those it has not yet, by its number."""


class Received:
    """One message, in the manner of pymavlink's: fields are attributes.

    Args:
        kind: its layout.
        frame: the whole frame, checked.
    """

    __slots__ = ("__dict__", "_frame", "_kind")

    def __init__(self, kind: Kind, frame: bytes) -> None:
        self._kind = kind
        self._frame = frame

    def __getattr__(self, name: str) -> object:
        if name.startswith("_") or name not in self._kind.names:
            raise AttributeError(f"no {name} in this message")
        self.__dict__.update(self._kind.decode(self._payload()))
        return self.__dict__[name]

    def __repr__(self) -> str:
        return f"{self._kind.name} {self._kind.decode(self._payload())}"

    def get_type(self) -> str:
        """The message's name."""
        return self._kind.name

    def get_msgId(self) -> int:  # noqa: N802 - pymavlink's name
        """The message's number."""
        return self._kind.message_id

    def get_seq(self) -> int:
        """The sender's sequence number."""
        return self._frame[4] if self._frame[0] == MAGIC_V2 else self._frame[2]

    def get_srcSystem(self) -> int:  # noqa: N802 - pymavlink's name
        """The sender's system id."""
        return self._frame[5] if self._frame[0] == MAGIC_V2 else self._frame[3]

    def get_srcComponent(self) -> int:  # noqa: N802 - pymavlink's name
        """The sender's component id."""
        return self._frame[6] if self._frame[0] == MAGIC_V2 else self._frame[4]

    def get_msgbuf(self) -> bytes:
        """The whole frame, with the signature that it may have."""
        return self._frame

    def time_boot_ms_or(self, default: int) -> int:
        """Its time_boot_ms, read without decoding the rest; `default` when it has none."""
        time_at = self._kind.time_at
        if time_at is None:
            return default
        frame = self._frame
        start = HEADER_V2_BYTES if frame[0] == MAGIC_V2 else HEADER_V1_BYTES
        at = start + time_at
        return int.from_bytes(frame[at : min(at + 4, start + frame[1])], "little")

    def _payload(self) -> bytes:
        start = HEADER_V2_BYTES if self._frame[0] == MAGIC_V2 else HEADER_V1_BYTES
        return self._frame[start : start + self._frame[1]]
