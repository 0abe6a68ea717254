"""Reading telemetry logs: Skein's own, and those of other stations."""

from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

from gcs.tlog import STAMP
from missions.errors import InputError
from sitl.services.codec import Codec
from sitl.services.peer import Message
from sitl.services.received import MAGIC_V1, MAGIC_V2, SIGNATURE_BYTES, SIGNED


class Logged(NamedTuple):
    """One message of a log.

    Attributes:
        time_s: Unix time.
        message: what was received or sent.
    """

    time_s: float
    message: Message


def read_tlog(path: Path, kinds: frozenset[int] | None = None) -> Iterator[Logged]:
    """The messages of a log in its order. What is damaged or of another dialect is passed over, a cut end too.

    Args:
        path: of the log.
        kinds: ids of the messages that are wanted; None for all. Others of MAVLink 2 are passed over by their
            length, undecoded.

    Raises:
        InputError: the file cannot be read, or there is no message in it.
    """
    try:
        data = path.read_bytes()
    except OSError as error:
        raise InputError(f"{path}: {error.strerror}; name a .tlog") from error
    at, found = 0, False
    codec = Codec(0, 0)
    while at + STAMP.size + 3 <= len(data):
        start = at + STAMP.size
        if kinds is not None and _is_other(data, start, kinds):
            found = True
            at = start + _frame_length(data, start)
            continue
        frame = data[start : start + _frame_length(data, start)]
        messages = codec.feed(frame)
        if messages and len(messages[0].get_msgbuf()) == len(frame):  # not one that a false start has swallowed
            found = True
            if kinds is None or _kind(data, start) in kinds:
                yield Logged(STAMP.unpack_from(data, at)[0] / 1e6, messages[0])
            at = start + len(frame)
        else:
            codec = Codec(0, 0)
            at += 1
    if not found:
        raise InputError(f"{path}: no MAVLink message in it; name a .tlog")


def _is_other(data: bytes, start: int, kinds: frozenset[int]) -> bool:
    """Whether a whole frame of MAVLink 2, of none of these kinds, stands at `start`, and another after it."""
    if data[start] != MAGIC_V2 or _kind(data, start) in kinds:
        return False
    after = start + _frame_length(data, start) + STAMP.size
    return after < len(data) and data[after] in (MAGIC_V1, MAGIC_V2)


def _kind(data: bytes, start: int) -> int:
    """The message id of the frame at `start`."""
    return data[start + 5] if data[start] == MAGIC_V1 else int.from_bytes(data[start + 7 : start + 10], "little")


def _frame_length(data: bytes, start: int) -> int:
    """How long the frame at `start` is; 0 when there is none."""
    if data[start] == MAGIC_V1:
        return data[start + 1] + 8
    if data[start] == MAGIC_V2:
        return data[start + 1] + 12 + (SIGNATURE_BYTES if data[start + 2] & SIGNED else 0)
    return 0
