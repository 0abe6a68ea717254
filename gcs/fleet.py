"""The vehicles that the station can hear, found by their heartbeats."""

import asyncio
import contextlib
import time
from collections.abc import Callable, Collection
from types import TracebackType

from pymavlink.dialects.v20 import ardupilotmega as mavlink

from gcs import station
from gcs.links.link import Link
from gcs.tlog import TelemetryLog
from gcs.vehicle_link import VehicleLink
from missions.errors import InputError
from sitl.services.codec import Codec
from sitl.services.peer import Message, Peer

_HEARTBEAT_PERIOD_S = 1.0
_SILENCE_S = 5.0
"""A vehicle may come back at another address after it has been silent at the old one for so long."""


class Fleet:
    """All vehicles on all links. An async context: it sends the station's heartbeats, and closes links and logs.

    Args:
        open_log: called with the system id of each new vehicle for the log of its traffic.

    Attributes:
        vehicles: by system id.
    """

    def __init__(self, open_log: Callable[[int], TelemetryLog] | None = None) -> None:
        self.vehicles: dict[int, VehicleLink] = {}
        self._open_log = open_log
        self._logs: list[TelemetryLog] = []
        self._links: list[Link] = []
        self._codecs: dict[tuple[Link, Peer], Codec] = {}
        self._conflicts: dict[int, str] = {}
        self._news = asyncio.Event()
        self._heartbeats: asyncio.Task[None] | None = None

    async def __aenter__(self) -> "Fleet":
        self._heartbeats = asyncio.create_task(self._send_heartbeats())
        return self

    async def __aexit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if self._heartbeats is not None:
            self._heartbeats.cancel()
            with contextlib.suppress(asyncio.CancelledError):
                await self._heartbeats
        for link in self._links:
            await link.close()
        for log in self._logs:
            log.close()

    def attach(self, link: Link) -> None:
        """Listen on this link, and close it in the end."""
        self._links.append(link)
        link.on_bytes = lambda data, peer: self._on_bytes(link, data, peer)

    async def wait_for(self, sysids: Collection[int], timeout_s: float) -> list[VehicleLink]:
        """Wait until all these vehicles have been heard.

        Returns:
            The vehicles, in the order of `sysids`.

        Raises:
            InputError: some are missing after `timeout_s`, or two vehicles have one system id.
        """
        try:
            async with asyncio.timeout(timeout_s):
                while not self.vehicles.keys() >= set(sysids):
                    self._news.clear()
                    await self._news.wait()
                    self.check()
        except TimeoutError:
            missing = ", ".join(str(sysid) for sysid in sorted(set(sysids) - self.vehicles.keys()))
            text = (
                f"vehicle {missing}: no heartbeat within {timeout_s:g} s; check that it runs and sends to this station"
            )
            raise InputError(text) from None
        self.check()
        return [self.vehicles[sysid] for sysid in sysids]

    def check(self) -> None:
        """Raise InputError when two vehicles have been heard with one system id, or a log could not be written."""
        for text in self._conflicts.values():
            raise InputError(text)
        for log in self._logs:
            log.check()

    def _on_bytes(self, link: Link, data: bytes, peer: Peer) -> None:
        codec = self._codecs.setdefault((link, peer), Codec(station.SYSID, station.COMPID))
        for message in codec.feed(data):
            vehicle = self._vehicle_of(message, link, peer, codec)
            if vehicle is not None:
                vehicle.on_message(message)

    def _vehicle_of(self, message: Message, link: Link, peer: Peer, codec: Codec) -> VehicleLink | None:
        """The vehicle that sent the message; None when it is no vehicle, or not yet known as one, or an impostor."""
        sysid, compid = message.get_srcSystem(), message.get_srcComponent()
        vehicle = self.vehicles.get(sysid)
        if vehicle is not None and vehicle.compid == compid and vehicle.peer == peer:
            return vehicle
        if message.get_type() != "HEARTBEAT" or message.autopilot == mavlink.MAV_AUTOPILOT_INVALID:
            return None

        def send_message(message: Message) -> bytes:
            frame = codec.pack(message)
            link.send(frame, peer)
            return frame

        if vehicle is None:
            vehicle = VehicleLink(sysid, compid, peer, send_message, self._log_of(sysid))
            self.vehicles[sysid] = vehicle
        elif time.monotonic() - vehicle.heard_at_s > _SILENCE_S:
            vehicle.move_to(peer, send_message)
        else:
            text = f"system id {sysid} is used by {vehicle.peer} and {peer}; give each vehicle its own"
            self._conflicts.setdefault(sysid, text)
            vehicle = None
        self._news.set()
        return vehicle

    def _log_of(self, sysid: int) -> TelemetryLog | None:
        if self._open_log is None:
            return None
        log = self._open_log(sysid)
        self._logs.append(log)
        return log

    async def _send_heartbeats(self) -> None:
        while True:
            for vehicle in self.vehicles.values():
                vehicle.send(station.heartbeat())
            await asyncio.sleep(_HEARTBEAT_PERIOD_S)
