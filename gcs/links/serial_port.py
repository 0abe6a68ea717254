"""A serial port with a telemetry radio or an autopilot at its other end; when it is lost, it is opened again."""

import asyncio
import contextlib
import os
from typing import Any

from gcs.links.link import OnBytes, OnPeer, ignore_bytes, ignore_peer
from gcs.links.reopening import reopen
from missions.errors import InputError
from sitl.services.peer import Peer

_READ_BYTES = 65536
_BACKLOG_BYTES = 8 * 1024
"""What may wait for the port before more is lost: over a second at 57600 baud."""


class SerialLink:
    """One device.

    Attributes:
        on_bytes: called with whatever comes in.
        on_lost, on_back: called when the device is lost, and when it is there again.
        greeted: the device.
        peer: the device, with the baud rate for its port.
    """

    on_bytes: OnBytes
    on_lost: OnPeer
    on_back: OnPeer

    def __init__(self, device: str, baud: int) -> None:
        self.on_bytes = ignore_bytes
        self.on_lost = self.on_back = ignore_peer
        self.peer = Peer("serial", device, baud)
        self.greeted = (self.peer,)
        self._port: Any = None
        self._backlog = bytearray()
        self._reopening: asyncio.Task[None] | None = None

    @classmethod
    async def open(cls, device: str, baud: int) -> "SerialLink":
        """Open the device; raises InputError when that cannot be done, or pyserial is not there."""
        link = cls(device, baud)
        try:
            await link._open()
        except ImportError as error:
            text = f"{link.peer}: serial ports need pyserial; install the extra: pip install 'skein-gcs[serial]'"
            raise InputError(text) from error
        except (OSError, ValueError) as error:
            raise InputError(f"{link.peer}: {error}; check the device and the baud rate") from error
        return link

    def send(self, data: bytes, peer: Peer) -> None:
        """Send to the other end, as fast as the port takes it."""
        if self._port is not None and len(self._backlog) + len(data) <= _BACKLOG_BYTES:
            self._backlog += data
            self._write()

    async def close(self) -> None:
        """Close the device, for good."""
        if self._reopening is not None:
            self._reopening.cancel()
            await asyncio.wait({self._reopening})
        self._drop()

    async def _open(self) -> None:
        import serial

        self._port = serial.Serial(self.peer.host, self.peer.port, timeout=0, exclusive=True)
        asyncio.get_running_loop().add_reader(self._port.fileno(), self._read)

    def _read(self) -> None:
        try:
            data = os.read(self._port.fileno(), _READ_BYTES)
        except BlockingIOError:
            return
        except OSError:
            data = b""
        if data:
            self.on_bytes(data, self.peer)
        else:
            self._lose()

    def _write(self) -> None:
        loop = asyncio.get_running_loop()
        try:
            with contextlib.suppress(BlockingIOError):
                del self._backlog[: os.write(self._port.fileno(), self._backlog)]
        except OSError:
            self._lose()
            return
        if self._backlog:
            loop.add_writer(self._port.fileno(), self._write)
        else:
            loop.remove_writer(self._port.fileno())

    def _lose(self) -> None:
        self._drop()
        self.on_lost(self.peer)
        self._reopening = asyncio.get_running_loop().create_task(self._come_back())

    async def _come_back(self) -> None:
        await reopen(self._open)
        self.on_back(self.peer)

    def _drop(self) -> None:
        if self._port is not None:
            loop, number = asyncio.get_running_loop(), self._port.fileno()
            loop.remove_reader(number)
            loop.remove_writer(number)
            self._port.close()
        self._port = None
        self._backlog.clear()
