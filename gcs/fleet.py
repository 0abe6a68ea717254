"""The vehicles that the station can hear, found by their heartbeats."""

import asyncio
import contextlib
import logging
import time
from collections.abc import Callable, Collection
from types import TracebackType

from pymavlink.dialects.v20 import ardupilotmega as mavlink

from gcs import station
from gcs.channel import Channel
from gcs.links.link import Link
from gcs.rejections import Rejections
from gcs.routes import Routes
from gcs.tlog import TelemetryLog
from gcs.vehicle_link import VehicleLink
from missions.errors import InputError
from sitl.services.peer import Message, Peer
from sitl.services.signing import Signing, Verdict

_log = logging.getLogger(__name__)

_HEARTBEAT_PERIOD_S = 1.0
_HEARD_OUT_S = 1.2
"""A heartbeat and a little: who else has a system id is heard within it."""
_FLUSH_PERIOD_S = 0.1
_STRANGERS = 256
"""Addresses remembered from which no vehicle has been heard yet."""


def _say_nothing(text: str) -> None:
    """What a fleet does with its news until someone wants it."""


class Fleet:
    """All vehicles of one MAVLink network, on all its links.

    An async context: it sends the station's heartbeats, and closes links and logs. Of several links to one vehicle one
    is in use, and the others are kept alive to take over when that falls silent. More vehicles than there are system
    ids are several networks: a fleet each.

    Args:
        open_log: called with the system id of each new vehicle for the log of its traffic.
        signing: the network's key; with one, only vehicles that sign with it are heard.
        announce: called with what becomes of the links, for people to read.

    Attributes:
        vehicles: by system id.
    """

    def __init__(
        self,
        open_log: Callable[[int], TelemetryLog] | None = None,
        signing: Signing | None = None,
        announce: Callable[[str], None] = _say_nothing,
    ) -> None:
        self.vehicles: dict[int, VehicleLink] = {}
        self._open_log = open_log
        self._signing = signing or Signing()
        self._announce = announce
        self._logs: list[TelemetryLog] = []
        self._links: list[Link] = []
        self._attached_at_s = time.monotonic()
        self._channels: dict[tuple[Link, Peer], Channel] = {}
        self._strangers: dict[tuple[Link, Peer], Channel] = {}
        self._channels_seen = 0
        self._forgotten = 0
        self._routes: dict[int, Routes] = {}
        self._rejections = Rejections()
        self._news = asyncio.Event()
        self._tasks: list[asyncio.Task[None]] = []

    async def __aenter__(self) -> "Fleet":
        self._tasks = [asyncio.create_task(self._send_heartbeats()), asyncio.create_task(self._flush_logs())]
        return self

    async def __aexit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        for task in self._tasks:
            task.cancel()
            with contextlib.suppress(asyncio.CancelledError):
                await task
        for link in self._links:
            await link.close()
        for log in self._logs:
            log.close()

    def attach(self, link: Link) -> None:
        """Listen on this link, and close it in the end."""
        self._links.append(link)
        self._attached_at_s = time.monotonic()
        link.on_bytes = lambda data, peer: self._on_bytes(link, data, peer)
        link.on_lost = lambda peer: self._on_lost(link, peer)
        link.on_back = lambda peer: self._on_back(link, peer)
        self._greet(link)

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
            raise InputError(self._missing(sysids, timeout_s)) from None
        self.check()
        return [self.vehicles[sysid] for sysid in sysids]

    async def hear(self, sysid: int, timeout_s: float) -> VehicleLink:
        """Wait until this vehicle has been heard, whatever the others do; it may be one of two with one system id.

        Raises:
            InputError: it is missing after `timeout_s`.
        """
        try:
            async with asyncio.timeout(timeout_s):
                while sysid not in self.vehicles:
                    self._news.clear()
                    await self._news.wait()
        except TimeoutError:
            raise InputError(self._missing([sysid], timeout_s)) from None
        return self.vehicles[sysid]

    async def hear_one(self, timeout_s: float) -> VehicleLink:
        """Wait until a vehicle has been heard, and whether it is the only one.

        Raises:
            InputError: there is none after `timeout_s`, or there are several.
        """
        try:
            async with asyncio.timeout(timeout_s):
                while not self.vehicles:
                    self._news.clear()
                    await self._news.wait()
        except TimeoutError:
            raise InputError("; ".join([f"no vehicle heard within {timeout_s:g} s", *self.complaints()])) from None
        await self.hear_out()
        if len(self.vehicles) > 1:
            raise InputError(f"vehicles {sorted(self.vehicles)} are heard there; one alone is wanted")
        self.check()
        return next(iter(self.vehicles.values()))

    async def hear_out(self) -> None:
        """Wait until all who may have come to a listening socket have had the time of a heartbeat; then ask `doubled`.

        Where the station calls, a link leads to one address.
        """
        if any(not link.greeted for link in self._links):
            await asyncio.sleep(max(0.0, self._attached_at_s + _HEARD_OUT_S - time.monotonic()))

    async def discover(self, seconds: float) -> list[VehicleLink]:
        """Listen for so long, some heartbeats' time; `check` says whether two have one system id.

        Returns:
            All vehicles, in the order of their system ids.

        Raises:
            InputError: there are none.
        """
        await asyncio.sleep(seconds)
        if not self.vehicles:
            raise InputError("; ".join([f"no vehicle heard within {seconds:g} s", *self.complaints()]))
        return [self.vehicles[sysid] for sysid in sorted(self.vehicles)]

    def doubled(self, sysid: int) -> str | None:
        """Who else has been heard with this system id, for people; None when nobody has."""
        routes = self._routes.get(sysid)
        if routes is None or routes.rival is None:
            return None
        return f"system id {sysid} is used by {routes.used.peer} and {routes.rival.peer}; give each vehicle its own"

    def check(self) -> None:
        """Raise InputError when two vehicles have been heard with one system id, or a log could not be written."""
        for sysid in self._routes:
            if reason := self.doubled(sysid):
                raise InputError(reason)
        for log in self._logs:
            log.check()

    def complaints(self) -> list[str]:
        """What did not come through, a line for people each: rejected frames, damaged ones, lost ones."""
        lines = self._rejections.all()
        for channel in (*self._channels.values(), *self._strangers.values()):
            codec = channel.codec
            if codec.damaged:
                lines.append(f"{channel.peer}: damaged data {codec.damaged} times: check the link")
            if codec.unknown:
                lines.append(f"{channel.peer}: {codec.unknown} messages of another dialect, or damaged")
        if self._forgotten:
            lines.append(f"{self._forgotten} further addresses sent no vehicle's heartbeat")
        lines += [f"{one}: {one.lost_frames} frames lost" for one in self.vehicles.values() if one.lost_frames]
        return lines

    def _missing(self, sysids: Collection[int], timeout_s: float) -> str:
        missing = sorted(set(sysids) - self.vehicles.keys())
        reasons = [line for sysid in missing for line in self._rejections.of(sysid)]
        advice = "; ".join(reasons) or "check that it runs and sends to this station"
        return f"vehicle {', '.join(map(str, missing))}: no heartbeat within {timeout_s:g} s; {advice}"

    def _on_bytes(self, link: Link, data: bytes, peer: Peer) -> None:
        channel = self._channels.get((link, peer)) or self._stranger(link, peer)
        with channel.gathering():
            for message in channel.codec.feed(data):
                self._on_message(message, channel)

    def _on_message(self, message: Message, channel: Channel) -> None:
        """Take one message that has come over a channel, if it may have an effect."""
        sysid = message.get_srcSystem()
        vehicle = self.vehicles.get(sysid)
        signing = self._signing if vehicle is None else vehicle.signing
        verdict = signing.judge(message.get_msgbuf())
        if verdict is not Verdict.GOOD:
            self._rejections.count(sysid, verdict)
            return
        channel.heard_at_s = time.monotonic()
        known = vehicle is not None and vehicle.compid == message.get_srcComponent()
        if not known or self._routes[sysid].used is not channel:
            vehicle = self._introduce(message, channel)
        if vehicle is not None:
            vehicle.on_message(message)

    def _stranger(self, link: Link, peer: Peer) -> Channel:
        """The channel of a peer from which no vehicle has been heard; those that came first are forgotten first."""
        channel = self._strangers.get((link, peer))
        if channel is None:
            channel = self._strangers[link, peer] = Channel(link, peer, self._channels_seen)
            self._channels_seen += 1
            if len(self._strangers) > _STRANGERS:
                del self._strangers[next(iter(self._strangers))]
                self._forgotten += 1
        return channel

    def _introduce(self, message: Message, channel: Channel) -> VehicleLink | None:
        """The vehicle that sent a message which did not come the usual way; None when it is not to be heard."""
        sysid, compid = message.get_srcSystem(), message.get_srcComponent()
        kind = message.get_type()
        vehicle = self.vehicles.get(sysid)
        if vehicle is not None and kind == "GLOBAL_POSITION_INT" and "GLOBAL_POSITION_INT" in vehicle.latest:
            first = vehicle.latest["GLOBAL_POSITION_INT"]
            self._routes[sysid].compare(channel, first, message, vehicle.pace)
        if kind != "HEARTBEAT" or message.autopilot == mavlink.MAV_AUTOPILOT_INVALID:
            return None
        self._news.set()
        if vehicle is None:
            send = self._sender(sysid, channel)
            vehicle = VehicleLink(sysid, compid, channel.peer, send, self._log_of(sysid), self._signing)
            self.vehicles[sysid], self._routes[sysid] = vehicle, Routes(channel)
            _log.info("%s found at %s: autopilot %d, type %d", vehicle, channel.peer, message.autopilot, message.type)
        elif compid != vehicle.compid:
            self._routes[sysid].rival = channel
            _log.debug("%s: a second one of this system id at %s", vehicle, channel.peer)
            return None
        else:
            used = self._routes[sysid].used
            if not self._routes[sysid].offer(channel):
                self._sort_channels()
                return None
            self._announce(f"{vehicle}: now heard over {channel.peer}, no longer over {used.peer}")
            vehicle.move_to(channel.peer, self._sender(sysid, channel))
        self._sort_channels()
        return vehicle

    def _sender(self, sysid: int, channel: Channel) -> Callable[[Message], bytes]:
        return lambda message: channel.send(message, self.vehicles[sysid].signing)

    def _sort_channels(self) -> None:
        """Keep apart the channels that lead to vehicles, and those that may be forgotten."""
        leading = {channel for routes in self._routes.values() for channel in (routes.used, *routes.standby)}
        known = {(channel.link, channel.peer): channel for channel in leading}
        self._strangers.update((key, self._channels[key]) for key in self._channels.keys() - known.keys())
        for key in known:
            self._strangers.pop(key, None)
        self._channels = known

    def _on_lost(self, link: Link, peer: Peer) -> None:
        self._announce(f"{peer}: connection lost")
        channel = self._channels.get((link, peer))
        if channel is not None:
            channel.open = False
            for routes in self._routes.values():
                routes.forget(channel)
            self._sort_channels()

    def _on_back(self, link: Link, peer: Peer) -> None:
        self._announce(f"{peer}: connected")
        channel = self._channels.get((link, peer)) or self._stranger(link, peer)
        channel.open = True
        self._greet(link)

    def _log_of(self, sysid: int) -> TelemetryLog | None:
        if self._open_log is None:
            return None
        log = self._open_log(sysid)
        self._logs.append(log)
        return log

    def _greet(self, link: Link) -> None:
        """Tell those whom no vehicle has been heard from that there is a station."""
        for peer in link.greeted:
            if (link, peer) not in self._channels:
                self._stranger(link, peer).send(station.heartbeat(), self._signing)

    async def _send_heartbeats(self) -> None:
        while True:
            for vehicle in self.vehicles.values():
                vehicle.send(station.heartbeat())
                for channel in self._routes[vehicle.sysid].standby:
                    channel.send(station.heartbeat(), vehicle.signing)
            for link in self._links:
                self._greet(link)
            await asyncio.sleep(_HEARTBEAT_PERIOD_S)

    async def _flush_logs(self) -> None:
        while True:
            await asyncio.sleep(_FLUSH_PERIOD_S)
            for log in self._logs:
                log.flush()
