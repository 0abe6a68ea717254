"""STATUSTEXT: a line of any length in pieces of 50 bytes."""

from pymavlink.dialects.v20 import ardupilotmega as mavlink

from sitl.events import StatusText
from sitl.services.peer import Message

_PIECE_BYTES = 50


def status_text_messages(status: StatusText, text_id: int) -> list[Message]:
    """The STATUSTEXT messages that carry `status`.

    Args:
        status: the line.
        text_id: ties the pieces of one long line together; 1 to 65535.
    """
    text = status.text.encode("ascii", "replace")
    if len(text) <= _PIECE_BYTES:
        return [mavlink.MAVLink_statustext_message(status.severity, text)]
    # A piece with a NUL in it ends the line, so one of exactly 50 bytes wants an empty piece after it.
    starts = range(0, len(text) + 1, _PIECE_BYTES)
    return [
        mavlink.MAVLink_statustext_message(status.severity, text[start : start + _PIECE_BYTES], text_id, seq)
        for seq, start in enumerate(starts)
    ]
