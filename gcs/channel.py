"""One way to one address: a link, a peer on it, and the state of the frames exchanged with it."""

import time

from gcs import station
from gcs.links.link import Link
from sitl.services.codec import Codec
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

    __slots__ = ("codec", "heard_at_s", "link", "open", "peer")

    def __init__(self, link: Link, peer: Peer, link_id: int) -> None:
        self.link = link
        self.peer = peer
        self.codec = Codec(station.SYSID, station.COMPID, link_id % 256)
        self.heard_at_s = time.monotonic()
        self.open = True

    def send(self, message: Message, signing: Signer) -> bytes:
        """Send one message; returns the frame."""
        frame = self.codec.pack(message, signing)
        self.link.send(frame, self.peer)
        return frame

    def is_silent(self, now_s: float, for_s: float) -> bool:
        """Whether nothing has come for so long, or nothing can come any more."""
        return not self.open or now_s - self.heard_at_s > for_s
