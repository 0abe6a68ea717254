"""A TCP connection to one vehicle, as to a simulator's 5760; when it is lost, it is made again."""

import asyncio
import os
from typing import cast

from gcs.links.link import OnBytes, OnPeer, ignore_bytes, ignore_peer
from gcs.links.reopening import reopen
from missions.errors import InputError
from sitl.services.peer import Peer

BACKLOG_BYTES = 256 * 1024
"""What the other end may leave unread before more is lost."""


class TcpLink(asyncio.Protocol):
    """A client's connection.

    Attributes:
        on_bytes: called with whatever comes in.
        on_lost, on_back: called when the connection is lost, and when it is there again.
        greeted: the other end.
        peer: the other end.
    """

    on_bytes: OnBytes
    on_lost: OnPeer
    on_back: OnPeer

    def __init__(self, peer: Peer) -> None:
        self.on_bytes = ignore_bytes
        self.on_lost = self.on_back = ignore_peer
        self.greeted = (peer,)
        self.peer = peer
        self._transport: asyncio.Transport | None = None
        self._closed = asyncio.Event()
        self._closing = False
        self._reopening: asyncio.Task[None] | None = None

    @classmethod
    async def connect(cls, host: str, port: int) -> "TcpLink":
        """Connect; raises InputError when nobody listens there."""
        link = cls(Peer("tcp", host, port))
        try:
            await link._connect()
        except OSError as error:
            reason = os.strerror(error.errno) if error.errno and error.errno > 0 else error.strerror or str(error)
            raise InputError(f"{link.peer}: {reason}; start the vehicle or check the address") from error
        return link

    def send(self, data: bytes, peer: Peer) -> None:
        """Send to the other end."""
        transport = self._transport
        if transport is not None and transport.get_write_buffer_size() < BACKLOG_BYTES:
            transport.write(data)

    async def close(self) -> None:
        """Close the connection, for good."""
        self._closing = True
        if self._reopening is not None:
            self._reopening.cancel()
            await asyncio.wait({self._reopening})
        if self._transport is not None:
            self._transport.abort()
            await self._closed.wait()

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        """asyncio's: connected."""
        self._transport = cast(asyncio.Transport, transport)  # not all of asyncio's are instances of it

    def data_received(self, data: bytes) -> None:
        """asyncio's: bytes are in."""
        self.on_bytes(data, self.peer)

    def connection_lost(self, exc: Exception | None) -> None:
        """asyncio's: the connection is closed."""
        self._transport = None
        self._closed.set()
        if not self._closing:
            self.on_lost(self.peer)
            self._reopening = asyncio.get_running_loop().create_task(self._come_back())

    async def _connect(self) -> None:
        self._closed.clear()
        await asyncio.get_running_loop().create_connection(lambda: self, self.peer.host, self.peer.port)

    async def _come_back(self) -> None:
        await reopen(self._connect)
        self.on_back(self.peer)
