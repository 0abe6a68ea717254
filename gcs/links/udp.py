"""A UDP port on which many vehicles report, as on a ground station's 14550."""

import asyncio
import socket
from typing import cast

from gcs.links.link import OnBytes, ignore_bytes
from missions.errors import InputError
from sitl.services.peer import Peer

_RECEIVE_BUFFER_BYTES = 8 * 1024 * 1024


class UdpLink(asyncio.DatagramProtocol):
    """One port for all vehicles; each is answered at the address it came from.

    Attributes:
        on_bytes: called with each datagram.
        port: the local port.
    """

    on_bytes: OnBytes

    def __init__(self, port: int) -> None:
        self.on_bytes = ignore_bytes
        self.port = port
        self._transport: asyncio.DatagramTransport | None = None
        self._closed = asyncio.get_running_loop().create_future()

    @classmethod
    async def open(cls, port: int = 0, host: str = "127.0.0.1") -> "UdpLink":
        """Bind to a port, 0 for a free one; raises InputError when it is taken."""
        sock = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        sock.setblocking(False)
        sock.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, _RECEIVE_BUFFER_BYTES)
        try:
            sock.bind((host, port))
        except OSError as error:
            sock.close()
            reason = error.strerror or str(error)
            text = f"UDP port {port} on {host}: {reason}; stop what uses it or choose another port"
            raise InputError(text) from error
        bound = int(sock.getsockname()[1])
        _, link = await asyncio.get_running_loop().create_datagram_endpoint(lambda: cls(bound), sock=sock)
        return link

    def send(self, data: bytes, peer: Peer) -> None:
        """One datagram to the peer."""
        if self._transport is not None and not self._transport.is_closing():
            self._transport.sendto(data, (peer.host, peer.port))

    async def close(self) -> None:
        """Close the port."""
        if self._transport is not None:
            self._transport.close()
            await self._closed

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        """asyncio's: the port is open."""
        self._transport = cast(asyncio.DatagramTransport, transport)  # not all of asyncio's are instances of it

    def datagram_received(self, data: bytes, addr: tuple[str, int]) -> None:
        """asyncio's: a datagram is in."""
        self.on_bytes(data, Peer("udp", *addr))

    def error_received(self, exc: Exception) -> None:
        """asyncio's: a datagram was refused by its receiver; telemetry is lossy anyway."""

    def connection_lost(self, exc: Exception | None) -> None:
        """asyncio's: the port is closed."""
        self._closed.set_result(None)
