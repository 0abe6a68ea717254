"""MAVLink FTP, of which there is none: each request is refused at once, so that a station need not wait for nothing.

MAVProxy, for one, asks for a file of parameters first and for the parameters themselves only when that has failed.
"""

import struct

from pymavlink.dialects.v20 import ardupilotmega as mavlink

from sitl.services.peer import Message

_HEADER = struct.Struct("<HBBBBBBI")  # seq, session, opcode, size, request's opcode, burst complete, padding, offset
_PAYLOAD_BYTES = 251
_FIRST_REPLY = 128
_NAK = 129
_UNKNOWN_COMMAND = 7


def ftp_refusal(message: Message) -> Message | None:
    """The NAK of a FILE_TRANSFER_PROTOCOL request; None for what is itself an answer."""
    seq, session, opcode, *_ = _HEADER.unpack_from(bytes(message.payload))
    if opcode >= _FIRST_REPLY:
        return None
    header = _HEADER.pack((seq + 1) % 2**16, session, _NAK, 1, opcode, 0, 0, 0)
    payload = (header + bytes([_UNKNOWN_COMMAND])).ljust(_PAYLOAD_BYTES, b"\0")
    return mavlink.MAVLink_file_transfer_protocol_message(
        0, message.get_srcSystem(), message.get_srcComponent(), list(payload)
    )
