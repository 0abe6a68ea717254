"""One station connected over TCP, slow or dead as it may be."""

import socket
from dataclasses import dataclass, field

BACKLOG_BYTES = 256 * 1024
"""What a station may leave unread before it is dropped: some minutes of telemetry in real time."""


@dataclass
class TcpClient:
    """A non-blocking connection with a bounded backlog.

    Attributes:
        connection: the socket.
        backlog: bytes that the socket would not take yet.
        broken: nothing more can be sent; to be dropped.
    """

    connection: socket.socket
    backlog: bytearray = field(default_factory=bytearray)
    broken: bool = False

    def send(self, data: bytes) -> None:
        """Send or keep `data`; a client that leaves too much unread is broken."""
        self.backlog += data
        self.flush()
        if len(self.backlog) > BACKLOG_BYTES:
            self.broken = True

    def flush(self) -> None:
        """Send what the socket takes of the backlog."""
        try:
            while self.backlog and not self.broken:
                del self.backlog[: self.connection.send(self.backlog)]
        except BlockingIOError:
            pass
        except OSError:
            self.broken = True

    def receive(self) -> bytes:
        """What has come in; nothing and broken when the station has gone."""
        try:
            data = self.connection.recv(65536)
        except BlockingIOError:
            return b""
        except OSError:
            data = b""
        self.broken = self.broken or not data
        return data
