"""What the fleet asks of a link, whatever its transport."""

from collections.abc import Callable
from typing import Protocol, TypeAlias

from sitl.services.peer import Peer

OnBytes: TypeAlias = Callable[[bytes, Peer], None]
"""Called with each piece of data and the peer that it came from."""


def ignore_bytes(data: bytes, peer: Peer) -> None:
    """What a link does with data until someone listens."""


class Link(Protocol):
    """A transport with one or more peers at its other end.

    Attributes:
        on_bytes: set by whoever listens.
    """

    on_bytes: OnBytes

    def send(self, data: bytes, peer: Peer) -> None:
        """Send to one peer; what cannot be sent is lost."""

    async def close(self) -> None:
        """Close the sockets."""
