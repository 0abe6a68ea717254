"""A vehicle as its stations see it: all of its MAVLink services behind one entrance."""

import time
from collections.abc import Callable

from pymavlink.dialects.v20 import ardupilotmega as mavlink

from missions.frame import LocalFrame
from sitl.events import ItemReached, StatusText
from sitl.services.codec import Codec
from sitl.services.commands.server import CommandServer
from sitl.services.file_transfer import ftp_refusal
from sitl.services.heartbeat import heartbeat
from sitl.services.mission_server import MissionServer
from sitl.services.news import News
from sitl.services.outbox import Outbox
from sitl.services.parameters import ParameterServer
from sitl.services.peer import Message, Peer
from sitl.services.signing import Signing, Verdict
from sitl.services.signing_server import SigningServer
from sitl.services.status_text import status_text_messages
from sitl.services.stream_messages.streams import picture
from sitl.services.stream_messages.view import View
from sitl.services.telemetry import Telemetry
from sitl.services.vehicle import Vehicle
from sitl.snapshot import Snapshot

_HEARTBEAT_PERIOD_S = 1.0
_NEWS_PERIOD_S = 0.2
"""A change that no message from a station brought about is told so late at most."""
_AUTOPILOT = mavlink.MAV_COMP_ID_AUTOPILOT1
_LAST_TEXT_ID = 0xFFFF


class MavlinkFace:
    """Composes one vehicle's services. May be used from several threads: the vehicle's lock orders them.

    Telemetry, events and STATUSTEXT go to every peer, answers to the peer that asked. What one call has to say to a
    peer leaves together.

    Args:
        vehicle: the vehicle behind it.
        frame: the local frame of its position.
        send: puts bytes on the wire to a peer; must not block.
        now: wall time in seconds; only differences matter.
        signing: its key, if it has one or is to keep one that it is given.
        epoch_s: UNIX time at which simulated time is zero; by default, now.

    Attributes:
        rejected: frames without effect, because they were unsigned, wrongly signed or old.
    """

    def __init__(
        self,
        vehicle: Vehicle,
        frame: LocalFrame,
        send: Callable[[Peer, bytes], None],
        now: Callable[[], float],
        signing: Signing | None = None,
        epoch_s: float | None = None,
    ) -> None:
        self._vehicle = vehicle
        self._frame = frame
        self._send_bytes = send
        self._now = now
        self._epoch_s = time.time() if epoch_s is None else epoch_s
        self._sysid = vehicle.sysid
        self._codecs: dict[Peer, Codec] = {}
        self._outboxes: dict[Peer, Outbox] = {}
        self._greeted: set[Peer] = set()
        self._heartbeat_at_s = self._news_at_s = now()
        self._text_id = 0
        self.rejected = 0
        self._signing = signing or Signing()
        self._links_seen = 0
        self._keys = SigningServer(vehicle, self._signing, self._report)
        self._news = News()
        self._telemetry = Telemetry()
        self._missions = MissionServer(vehicle, self._reply, self._report, now)
        self._parameters = ParameterServer(vehicle.parameters, self._reply, self._broadcast, self._report, now)
        self._commands = CommandServer(vehicle, self._telemetry, self._view, self._reply, self._report)

    @property
    def skipped_bytes(self) -> int:
        """Bytes received from the present peers that belonged to no frame."""
        return sum(codec.skipped_bytes for codec in self._codecs.values())

    def add_peer(self, peer: Peer) -> None:
        """Telemetry goes to `peer` from now on."""
        with self._vehicle.lock:
            if peer not in self._codecs:
                self._codecs[peer] = Codec(self._sysid, _AUTOPILOT, link_id=self._links_seen % 256)
                self._outboxes[peer] = Outbox(lambda data: self._send_bytes(peer, data))
                self._links_seen += 1

    def remove_peer(self, peer: Peer) -> None:
        """`peer` is gone."""
        with self._vehicle.lock:
            self._codecs.pop(peer, None)
            self._outboxes.pop(peer, None)
            self._greeted.discard(peer)
            self._missions.forget(peer)
            self._parameters.forget(peer)
            self._telemetry.forget(peer)

    def on_bytes(self, data: bytes, peer: Peer) -> None:
        """Take what a peer sent: any bytes at all."""
        with self._vehicle.lock:
            self.add_peer(peer)
            for message in self._codecs[peer].feed(data):
                if self._signing.judge(message.get_msgbuf()) is Verdict.GOOD:
                    self._on_message(message, peer)
                else:
                    self.rejected += 1
            self._news_at_s = self._now()
            self._flush()

    def on_tick(self) -> None:
        """Do what wall time demands: heartbeats, time-outs, lists, events. Call it some ten times a second or more."""
        with self._vehicle.lock:
            now_s = self._now()
            self._vehicle.watch_station(now_s)
            self._take_name()
            if now_s >= self._heartbeat_at_s:
                self._heartbeat_at_s = now_s + _HEARTBEAT_PERIOD_S
                self._broadcast(heartbeat(self._vehicle.snapshot()))
            self._missions.on_tick()
            self._parameters.on_tick()
            self._keys.on_tick()
            self._tell_events()
            if now_s >= self._news_at_s:
                self._news_at_s = now_s + _NEWS_PERIOD_S
                for message in self._news.of(self._view()):
                    self._broadcast(message)
            self._flush()

    @property
    def deadline_s(self) -> float:
        """When `on_tick` has something overdue to ask for again; infinite when it has not."""
        return self._missions.deadline_s

    def wants(self, time_s: float) -> bool:
        """Whether `on_simulated_tick` has a stream to send at this simulated time; cheap."""
        return self._telemetry.is_due(time_s)

    def on_simulated_tick(self, snapshot: Snapshot) -> None:
        """Send the streams that are due at the snapshot's time, and the events so far."""
        with self._vehicle.lock:
            for peers, messages in self._telemetry.due(snapshot.time_s, self._codecs, lambda: self._view_of(snapshot)):
                for peer in peers:
                    for message in messages:
                        self._reply(message, peer)
            self._tell_events()
            self._flush()

    def _on_message(self, message: Message, peer: Peer) -> None:
        if getattr(message, "target_system", 0) not in (0, self._vehicle.sysid):
            return
        if getattr(message, "target_component", 0) not in (0, _AUTOPILOT):
            return
        match message.get_type():
            case "HEARTBEAT":
                self._on_heartbeat(message, peer)
            case "TIMESYNC":
                self._answer_timesync(message, peer)
            case "FILE_TRANSFER_PROTOCOL":
                if (refusal := ftp_refusal(message)) is not None:
                    self._reply(refusal, peer)
            case _:
                self._missions.on_message(message, peer)
                self._parameters.on_message(message, peer)
                self._commands.on_message(message, peer)
                self._keys.on_message(message)

    def _on_heartbeat(self, message: Message, peer: Peer) -> None:
        """A station is there. All are obeyed; MAV_GCS_SYSID is whose silence counts.

        One that is new here is shown everything at once, a heartbeat first: with the clock held, nothing falls due.
        """
        if message.type != mavlink.MAV_TYPE_GCS:
            return
        if message.get_srcSystem() == self._vehicle.parameters["MAV_GCS_SYSID"]:
            self._vehicle.hear_station(self._now())
        if peer not in self._greeted:
            self._greeted.add(peer)
            self._reply(heartbeat(self._vehicle.snapshot()), peer)
            for shown in picture(self._view()):
                self._reply(shown, peer)
            if (damage := self._vehicle.parameters.damage) is not None:
                self._report(StatusText(mavlink.MAV_SEVERITY_WARNING, damage))

    def _answer_timesync(self, message: Message, peer: Peer) -> None:
        if message.tc1 == 0:
            self._reply(mavlink.MAVLink_timesync_message(int(self._now() * 1e9), message.ts1), peer)

    def _take_name(self) -> None:
        """Speak under the system id that MAV_SYSID has been set to."""
        if self._sysid != self._vehicle.sysid:
            self._sysid = self._vehicle.sysid
            for codec in self._codecs.values():
                codec.rename(self._sysid)

    def _tell_events(self) -> None:
        for event in self._vehicle.drain_events():
            match event:
                case ItemReached(seq):
                    self._broadcast(mavlink.MAVLink_mission_item_reached_message(seq))
                case StatusText():
                    self._report(event)

    def _view(self) -> View:
        return self._view_of(self._vehicle.snapshot())

    def _view_of(self, snapshot: Snapshot) -> View:
        vehicle = self._vehicle
        return View(snapshot, self._frame, vehicle.home, vehicle.mission, self._missions.plan_ids, self._epoch_s)

    def _report(self, status: StatusText) -> None:
        self._text_id = self._text_id % _LAST_TEXT_ID + 1
        for message in status_text_messages(status, self._text_id):
            self._broadcast(message)

    def _broadcast(self, message: Message) -> None:
        for peer in self._codecs:
            self._reply(message, peer)

    def _reply(self, message: Message, peer: Peer) -> None:
        self._outboxes[peer].put(self._codecs[peer].pack(message, self._signing))

    def _flush(self) -> None:
        for outbox in self._outboxes.values():
            outbox.flush()
