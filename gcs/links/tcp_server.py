"""A TCP port to which vehicles connect."""

import asyncio
import socket
from typing import cast

from gcs.links.link import OnBytes, OnPeer, ignore_bytes, ignore_peer
from gcs.links.tcp import BACKLOG_BYTES
from missions.errors import InputError
from sitl.services.peer import Peer


class TcpServerLink:
    """Listens, and talks to all that come.

    Attributes:
        on_bytes: called with whatever comes in.
        on_lost, on_back: called when one has gone, and when one has come.
        greeted: all that are there.
        port: the local port.
    """

    on_bytes: OnBytes
    on_lost: OnPeer
    on_back: OnPeer

    def __init__(self) -> None:
        self.on_bytes = ignore_bytes
        self.on_lost = self.on_back = ignore_peer
        self.port = 0
        self.clients: dict[Peer, asyncio.Transport] = {}
        self._server: asyncio.Server | None = None

    @classmethod
    async def open(cls, port: int = 0, host: str = "127.0.0.1") -> "TcpServerLink":
        """Listen on a port, 0 for a free one; raises InputError when it cannot be had."""
        link = cls()
        loop = asyncio.get_running_loop()
        try:
            link._server = await loop.create_server(lambda: _Client(link), host, port, family=socket.AF_INET)
        except OSError as error:
            reason = error.strerror or str(error)
            text = f"TCP port {port} on {host}: {reason}; stop what uses it or choose another port"
            raise InputError(text) from error
        link.port = int(link._server.sockets[0].getsockname()[1])
        return link

    @property
    def greeted(self) -> tuple[Peer, ...]:
        """All that are there."""
        return tuple(self.clients)

    def send(self, data: bytes, peer: Peer) -> None:
        """Send to one of them."""
        transport = self.clients.get(peer)
        if transport is not None and transport.get_write_buffer_size() < BACKLOG_BYTES:
            transport.write(data)

    async def close(self) -> None:
        """Close the port and all connections."""
        self.on_lost = ignore_peer
        for transport in self.clients.values():
            transport.abort()
        if self._server is not None:
            self._server.close()
            await self._server.wait_closed()


class _Client(asyncio.Protocol):
    """One connection."""

    def __init__(self, link: TcpServerLink) -> None:
        self._link = link
        self._peer = Peer("tcp", "", 0)

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        self._peer = Peer("tcp", *transport.get_extra_info("peername")[:2])
        self._link.clients[self._peer] = cast(asyncio.Transport, transport)  # as asyncio's streams do
        self._link.on_back(self._peer)

    def data_received(self, data: bytes) -> None:
        self._link.on_bytes(data, self._peer)

    def connection_lost(self, exc: Exception | None) -> None:
        del self._link.clients[self._peer]
        self._link.on_lost(self._peer)
