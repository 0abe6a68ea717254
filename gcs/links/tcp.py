"""A TCP connection to one vehicle, as to a simulator's 5760."""

import asyncio
from typing import cast

from gcs.links.link import OnBytes, ignore_bytes
from missions.errors import InputError
from sitl.services.peer import Peer


class TcpLink(asyncio.Protocol):
    """A client's connection.

    Attributes:
        on_bytes: called with whatever comes in.
        peer: the other end.
    """

    on_bytes: OnBytes

    def __init__(self, peer: Peer) -> None:
        self.on_bytes = ignore_bytes
        self.peer = peer
        self._transport: asyncio.Transport | None = None
        self._closed = asyncio.get_running_loop().create_future()

    @classmethod
    async def connect(cls, host: str, port: int) -> "TcpLink":
        """Connect; raises InputError when nobody listens there."""
        peer = Peer("tcp", host, port)
        try:
            _, link = await asyncio.get_running_loop().create_connection(lambda: cls(peer), host, port)
        except OSError as error:
            reason = error.strerror or str(error)
            raise InputError(f"{peer}: {reason}; start the vehicle or check the address") from error
        return link

    def send(self, data: bytes, peer: Peer) -> None:
        """Send to the other end."""
        if self._transport is not None and not self._transport.is_closing():
            self._transport.write(data)

    async def close(self) -> None:
        """Close the connection."""
        if self._transport is not None:
            self._transport.abort()
            await self._closed

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        """asyncio's: connected."""
        self._transport = cast(asyncio.Transport, transport)  # not all of asyncio's are instances of it

    def data_received(self, data: bytes) -> None:
        """asyncio's: bytes are in."""
        self.on_bytes(data, self.peer)

    def connection_lost(self, exc: Exception | None) -> None:
        """asyncio's: the connection is closed."""
        self._closed.set_result(None)
