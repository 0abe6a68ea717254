"""The sockets of one endpoint: stations over UDP and TCP, run by one thread."""

import contextlib
import os
import selectors
import socket
import threading
import time
from collections.abc import Sequence
from functools import cached_property
from typing import Protocol

from missions.errors import InputError
from sitl.services.peer import Peer
from sitl.services.tcp_client import TcpClient

LOOPBACK = "127.0.0.1"

_DATAGRAMS_A_TURN = 64
_UDP_SILENCE_S = 30.0
"""A UDP peer that was not configured is dropped when nothing has been heard of it for so long."""
MOST_STRANGERS = 32
"""UDP peers that were not configured, and TCP clients: so many of each at a time."""
_PATIENCE_S = 3.0
"""When there are as many, one that has been silent for so long makes room: a station's heart beats faster."""


class Face(Protocol):
    """What the sockets are run for."""

    def add_peer(self, peer: Peer) -> None:
        """Someone can be reached."""

    def remove_peer(self, peer: Peer) -> None:
        """Someone has gone."""

    def on_bytes(self, data: bytes, peer: Peer) -> None:
        """Someone has sent something."""


class StationLinks:
    """Listens on TCP, sends to the configured stations over UDP, and answers whoever talks to its UDP port.

    One thread calls `poll`; `send` may be called from any thread and never blocks. `attach` comes first.

    Attributes:
        refused: datagrams and connections that there was no room for.

    Args:
        tcp_port: port to listen on, 0 for a free one.
        stations: (host, port) of the stations that get telemetry over UDP unasked.
        host: local address of all sockets.

    Raises:
        InputError: the TCP port cannot be had.
    """

    def __init__(self, tcp_port: int = 0, stations: Sequence[tuple[str, int]] = (), host: str = LOOPBACK) -> None:
        self._listener = _listen(host, tcp_port)
        self._udp = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self._udp.bind((host, 0))
        self._udp.setblocking(False)
        self._wake_reader, self._wake_writer = socket.socketpair()
        self._wake_reader.setblocking(False)
        self._wake_writer.setblocking(False)
        self._lock = threading.Lock()
        self._clients: dict[Peer, TcpClient] = {}
        self._stations = frozenset(Peer("udp", *station) for station in stations)
        self._heard_at_s: dict[Peer, float] = {}
        self.refused = 0
        self.tcp_port = int(self._listener.getsockname()[1])
        self.udp_port = int(self._udp.getsockname()[1])

    @cached_property
    def _selector(self) -> selectors.DefaultSelector:
        """Made in the process that polls, since a fork does not always inherit one."""
        selector = selectors.DefaultSelector()
        for reader in (self._listener, self._udp, self._wake_reader):
            selector.register(reader, selectors.EVENT_READ)
        return selector

    def attach(self, face: Face) -> None:
        """Serve this face from now on."""
        self._face = face
        for station in self._stations:
            face.add_peer(station)

    def send(self, peer: Peer, data: bytes) -> None:
        """Send to a peer, over UDP as one datagram. What cannot be sent is lost, and a TCP client then dropped."""
        if peer.transport == "udp":
            with contextlib.suppress(OSError):
                self._udp.sendto(data, (peer.host, peer.port))
            return
        with self._lock:
            client = self._clients.get(peer)
            if client is None:
                return
            client.send(data)
            unfinished = bool(client.backlog) or client.broken
        if unfinished:
            self._wake()

    def fileno(self) -> int:
        """Of what becomes readable when there is something to `poll`: the sockets of many can be waited for as one."""
        return self._selector.fileno()

    def stop_waiting(self) -> None:
        """Make a waiting `poll` return."""
        self._wake()

    def poll(self, timeout_s: float) -> None:
        """One turn: wait for traffic at most so long, and serve it."""
        self._watch_clients()
        for key, events in self._selector.select(timeout_s):
            if key.fileobj is self._listener:
                self._accept()
            elif key.fileobj is self._udp:
                self._receive_udp()
            elif key.fileobj is self._wake_reader:
                with contextlib.suppress(BlockingIOError):
                    self._wake_reader.recv(4096)
            else:
                self._serve_client(key.data, events)
        self._drop_silent_udp_peers()

    def close(self) -> None:
        """Close every socket; nobody polls any more."""
        self._selector.close()
        for client in self._clients.values():
            client.connection.close()
        for end in (self._listener, self._udp, self._wake_reader, self._wake_writer):
            end.close()

    def _wake(self) -> None:
        with contextlib.suppress(BlockingIOError):
            self._wake_writer.send(b"\0")

    def _accept(self) -> None:
        try:
            connection, (host, port) = self._listener.accept()
        except OSError:  # gone again before it was accepted
            return
        if len(self._clients) >= MOST_STRANGERS:
            connection.close()
            self.refused += 1
            return
        connection.setblocking(False)
        connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        peer = Peer("tcp", host, port)
        with self._lock:
            self._clients[peer] = TcpClient(connection)
        self._selector.register(connection, selectors.EVENT_READ, peer)
        self._face.add_peer(peer)

    def _receive_udp(self) -> None:
        for _ in range(_DATAGRAMS_A_TURN):
            try:
                data, address = self._udp.recvfrom(65536)
            except BlockingIOError:
                return
            except OSError:  # an earlier datagram was refused by its receiver
                continue
            peer = Peer("udp", *address)
            if peer in self._stations or self._has_room_for(peer):
                self._face.on_bytes(data, peer)
            else:
                self.refused += 1

    def _has_room_for(self, peer: Peer) -> bool:
        """Whether a UDP peer that was not configured may be heard: no number of ports costs memory or evicts anyone."""
        now_s = time.monotonic()
        if peer not in self._heard_at_s and len(self._heard_at_s) >= MOST_STRANGERS:
            oldest = min(self._heard_at_s, key=self._heard_at_s.__getitem__)
            if now_s - self._heard_at_s[oldest] < _PATIENCE_S:
                return False
            del self._heard_at_s[oldest]
            self._face.remove_peer(oldest)
        self._heard_at_s[peer] = now_s
        return True

    def _serve_client(self, peer: Peer, events: int) -> None:
        client = self._clients[peer]
        with self._lock:
            if events & selectors.EVENT_WRITE:
                client.flush()
            data = client.receive() if events & selectors.EVENT_READ else b""
        if data:
            self._face.on_bytes(data, peer)

    def _watch_clients(self) -> None:
        """Drop the broken clients, and wait for room to write where there is a backlog."""
        with self._lock:
            broken = {peer: client for peer, client in self._clients.items() if client.broken}
            for peer in broken:
                del self._clients[peer]
            for peer, client in self._clients.items():
                wanted = selectors.EVENT_READ | (selectors.EVENT_WRITE if client.backlog else 0)
                if self._selector.get_key(client.connection).events != wanted:
                    self._selector.modify(client.connection, wanted, peer)
        for peer, client in broken.items():
            self._selector.unregister(client.connection)
            client.connection.close()
            self._face.remove_peer(peer)

    def _drop_silent_udp_peers(self) -> None:
        limit_s = time.monotonic() - _UDP_SILENCE_S
        for peer in [peer for peer, heard_at_s in self._heard_at_s.items() if heard_at_s < limit_s]:
            del self._heard_at_s[peer]
            self._face.remove_peer(peer)


def _listen(host: str, port: int) -> socket.socket:
    listener = socket.socket(socket.AF_INET, socket.SOCK_STREAM)
    if os.name == "posix":  # elsewhere it would let two endpoints share a port
        listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    try:
        listener.bind((host, port))
        listener.listen()
    except OSError as error:
        listener.close()
        reason = error.strerror or str(error)
        raise InputError(f"TCP port {port} on {host}: {reason}; stop what uses it or choose another port") from error
    listener.setblocking(False)
    return listener
