"""A UDP port: one on which many vehicles report, as on a ground station's 14550, or one towards a single address."""

import asyncio
import contextlib
import socket

from gcs.links.link import OnBytes, OnPeer, ignore_bytes, ignore_peer
from missions.errors import InputError
from sitl.services.peer import Peer

_RECEIVE_BUFFER_BYTES = 8 * 1024 * 1024
_LARGEST_DATAGRAM = 65536
_PER_TURN = 256
"""Datagrams taken at most before others get their turn of the loop."""
_WINDOW_S = 0.5
_DENSE = 1000
"""Datagrams in a window from which on it pays to look for them now and then, rather than to be woken by each."""
_LOOK_PERIOD_S = 0.002


class UdpLink:
    """A port, and whoever is at the other end of it.

    Args:
        sock: bound, non-blocking; connected when there is a target.
        target: the only peer, sent to from the start; None for whoever sends to the port.

    Attributes:
        on_bytes: called with each datagram.
        on_lost, on_back: never called, for there is no connection.
        greeted: the target, if there is one.
        port: the local port.
    """

    on_bytes: OnBytes
    on_lost: OnPeer
    on_back: OnPeer

    def __init__(self, sock: socket.socket, target: Peer | None = None) -> None:
        self.on_bytes = ignore_bytes
        self.on_lost = self.on_back = ignore_peer
        self.greeted: tuple[Peer, ...] = () if target is None else (target,)
        self.port = int(sock.getsockname()[1])
        self._socket = sock
        self._loop = asyncio.get_running_loop()
        self._look: asyncio.TimerHandle | None = None
        self._window_ends_s = self._loop.time() + _WINDOW_S
        self._in_window = 0
        self._dense = False
        self._loop.add_reader(sock, self._on_readable)

    @classmethod
    async def open(cls, port: int = 0, host: str = "127.0.0.1") -> "UdpLink":
        """Listen on a port, 0 for a free one; raises InputError when it cannot be had."""
        sock = _socket()
        try:
            sock.bind((host, port))
        except OSError as error:
            sock.close()
            reason = error.strerror or str(error)
            text = f"UDP port {port} on {host}: {reason}; stop what uses it or choose another port"
            raise InputError(text) from error
        return cls(sock)

    @classmethod
    async def connect(cls, host: str, port: int) -> "UdpLink":
        """Send to an address from a free port and hear nobody else; raises InputError when there is no such host."""
        sock = _socket()
        try:
            found = await asyncio.get_running_loop().getaddrinfo(host, port, family=socket.AF_INET)
            sock.connect(found[0][4])
        except OSError as error:
            sock.close()
            raise InputError(f"udp {host}:{port}: {error.strerror or error}; check the address") from error
        return cls(sock, Peer("udp", *sock.getpeername()))

    def send(self, data: bytes, peer: Peer) -> None:
        """One datagram to the peer."""
        with contextlib.suppress(OSError):
            if self.greeted:
                self._socket.send(data)
            else:
                self._socket.sendto(data, (peer.host, peer.port))

    async def close(self) -> None:
        """Close the port."""
        self._loop.remove_reader(self._socket)
        if self._look is not None:
            self._look.cancel()
        self._socket.close()

    def _on_readable(self) -> None:
        """Take what is there; when it comes thick and fast, stop being woken and look from time to time."""
        if self._receive():
            self._loop.remove_reader(self._socket)
            self._look = self._loop.call_later(_LOOK_PERIOD_S, self._on_look)

    def _on_look(self) -> None:
        """Take what is there; when it has become quiet, be woken again."""
        if self._receive():
            self._look = self._loop.call_later(_LOOK_PERIOD_S, self._on_look)
        else:
            self._look = None
            self._loop.add_reader(self._socket, self._on_readable)

    def _receive(self) -> bool:
        """Take what is there, up to a turn's worth; whether the last window was dense."""
        receive, on_bytes = self._socket.recvfrom, self.on_bytes
        for _ in range(_PER_TURN):
            try:
                data, (host, port) = receive(_LARGEST_DATAGRAM)
            except BlockingIOError:
                break
            except OSError:  # an earlier datagram was refused by its receiver; telemetry is lossy anyway
                continue
            self._in_window += 1
            on_bytes(data, Peer("udp", host, port))
        if self._loop.time() >= self._window_ends_s:
            self._dense = self._in_window >= _DENSE
            self._in_window = 0
            self._window_ends_s = self._loop.time() + _WINDOW_S
        return self._dense


def _socket() -> socket.socket:
    sock = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    sock.setblocking(False)
    sock.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, _RECEIVE_BUFFER_BYTES)
    return sock
