"""Frames on their way to one peer: what is said at once leaves at once, in datagrams that networks carry whole."""

from collections.abc import Callable

LARGEST_DATAGRAM_BYTES = 1400
"""With its headers it fits an Ethernet frame: were it cut up on its way, all of it would be lost with any part."""


class Outbox:
    """Gathers frames until `flush`; a datagram that is full leaves before.

    Sending and receiving a datagram costs either end more than packing and parsing the frames in it.

    Args:
        send: puts bytes on the wire, over UDP as one datagram.
    """

    __slots__ = ("_send", "_waiting")

    def __init__(self, send: Callable[[bytes], None]) -> None:
        self._send = send
        self._waiting = bytearray()

    def __len__(self) -> int:
        return len(self._waiting)

    def put(self, frame: bytes) -> None:
        """Add one frame."""
        if len(self._waiting) + len(frame) > LARGEST_DATAGRAM_BYTES:
            self.flush()
        self._waiting += frame

    def flush(self) -> None:
        """Send what there is."""
        if self._waiting:
            data = bytes(self._waiting)
            self._waiting.clear()
            self._send(data)
