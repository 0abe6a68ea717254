"""MAVLink frames to messages and back, for one peer, whatever bytes come."""

from pymavlink.dialects.v20 import ardupilotmega as mavlink

from sitl.services.peer import Message

_MAGIC_V1, _MAGIC_V2 = 0xFE, 0xFD
_SIGNED = 0x01
_SIGNATURE_LENGTH = 13


class Codec:
    """Packs and parses the frames exchanged with one peer.

    Where a frame does not hold (checksum, flags, an id outside the dialect), the search for the next one starts one
    byte further on, so that garbage never swallows the frame behind it.

    Args:
        sysid, compid: the sender's ids put on packed frames.

    Attributes:
        skipped_bytes: bytes received so far that belonged to no frame of the dialect.
    """

    def __init__(self, sysid: int, compid: int) -> None:
        self._mavlink = mavlink.MAVLink(None, srcSystem=sysid, srcComponent=compid)
        self._buffer = bytearray()
        self.skipped_bytes = 0

    def pack(self, message: Message) -> bytes:
        """One MAVLink 2 frame, with this peer's next sequence number."""
        frame = bytes(message.pack(self._mavlink))
        self._mavlink.seq = (self._mavlink.seq + 1) % 256
        return frame

    def feed(self, data: bytes) -> list[Message]:
        """The messages that `data` completes, in order."""
        buffer = self._buffer
        buffer += data
        messages = []
        start = 0
        while True:
            frame_start = _find_magic(buffer, start)
            self.skipped_bytes += frame_start - start
            start = frame_start
            length = _frame_length(buffer, start)
            if length is None or len(buffer) - start < length:
                break
            message = self._decode(buffer[start : start + length])
            if message is None:
                self.skipped_bytes += 1
                start += 1
            else:
                messages.append(message)
                start += length
        del buffer[:start]
        return messages

    def _decode(self, frame: bytearray) -> Message | None:
        if frame[0] == _MAGIC_V2 and frame[2] & ~_SIGNED:
            return None
        try:
            message = self._mavlink.decode(frame)
        except mavlink.MAVError:
            return None
        return None if isinstance(message, mavlink.MAVLink_unknown) else message


def _find_magic(buffer: bytearray, start: int) -> int:
    if start < len(buffer) and buffer[start] in (_MAGIC_V2, _MAGIC_V1):
        return start
    found = [at for at in (buffer.find(_MAGIC_V2, start), buffer.find(_MAGIC_V1, start)) if at >= 0]
    return min(found, default=len(buffer))


def _frame_length(buffer: bytearray, start: int) -> int | None:
    """Length of the frame that would start at `start`; None while its header is not all in."""
    if len(buffer) - start < 3:
        return None
    payload = buffer[start + 1]
    if buffer[start] == _MAGIC_V1:
        return 6 + payload + 2
    return 10 + payload + 2 + (_SIGNATURE_LENGTH if buffer[start + 2] & _SIGNED else 0)
