"""What the fleet asks of a link, whatever its transport."""

from collections.abc import Callable
from typing import Protocol, TypeAlias

from sitl.services.peer import Peer

OnBytes: TypeAlias = Callable[[bytes, Peer], None]
"""Called with each piece of data and the peer that it came from."""
OnPeer: TypeAlias = Callable[[Peer], None]
"""Called when the connection to a peer is lost, or there again."""


def ignore_bytes(data: bytes, peer: Peer) -> None:
    """What a link does with data until someone listens."""


def ignore_peer(peer: Peer) -> None:
    """What a link does with news of a connection until someone listens."""


class Link(Protocol):
    """A transport with one or more peers at its other end.

    Attributes:
        on_bytes, on_lost, on_back: set by whoever listens.
        greeted: the peers that are sent to before anything has come from them.
    """

    on_bytes: OnBytes
    on_lost: OnPeer
    on_back: OnPeer

    @property
    def greeted(self) -> tuple[Peer, ...]:
        """See the class."""

    def send(self, data: bytes, peer: Peer) -> None:
        """Send to one peer; what cannot be sent is lost."""

    async def close(self) -> None:
        """Close the sockets."""
