"""One way to one address: a link, a peer on it, and the state of the frames exchanged with it."""

import time
from collections.abc import Iterator
from contextlib import contextmanager

from gcs import station
from gcs.links.link import Link
from sitl.services.codec import Codec
from sitl.services.outbox import Outbox
from sitl.services.peer import Message, Peer
from sitl.services.signing import Signer


class Channel:
    """A peer on a link.

    Args:
        link, peer: where it is.
        link_id: its number in signatures.

    Attributes:
        codec: of the frames exchanged with the peer.
        heard_at_s: when a frame last came, `time.monotonic` seconds.
        open: whether there is still a connection, on links that have one.
    """

    __slots__ = ("_gathering", "_outbox", "codec", "heard_at_s", "link", "open", "peer")

    def __init__(self, link: Link, peer: Peer, link_id: int) -> None:
        self.link = link
        self.peer = peer
        self.codec = Codec(station.SYSID, station.COMPID, link_id % 256)
        self.heard_at_s = time.monotonic()
        self.open = True
        self._outbox = Outbox(lambda data: link.send(data, peer))
        self._gathering = False

    def send(self, message: Message, signing: Signer) -> bytes:
        """Send one message; returns the frame."""
        frame = self.codec.pack(message, signing)
        self._outbox.put(frame)
        if not self._gathering:
            self._outbox.flush()
        return frame

    @contextmanager
    def gathering(self) -> Iterator[None]:
        """What is sent within this context leaves together at its end."""
        self._gathering = True
        try:
            yield
        finally:
            self._gathering = False
            self._outbox.flush()

    def is_silent(self, now_s: float, for_s: float) -> bool:
        """Whether nothing has come for so long, or nothing can come any more."""
        return not self.open or now_s - self.heard_at_s > for_s
