"""The vehicle's end of the MAVLink mission protocol: upload, download and clear of its one mission."""

from collections.abc import Callable
from dataclasses import dataclass, field

from pymavlink.dialects.v20 import ardupilotmega as mavlink

from missions.errors import InputError
from missions.mission import Mission, MissionItem
from missions.plan_type import PlanType
from sitl.events import StatusText
from sitl.modes import Mode
from sitl.services.mission_items import check_item, item_message
from sitl.services.opaque_id import MissionAck, MissionCount, opaque_id
from sitl.services.peer import Message, Peer, Send, Station
from sitl.services.vehicle import Vehicle

MAX_ITEMS = 700
"""Largest mission held, home included."""

REQUEST_AGAIN_S = 1.0
GIVE_UP_S = 8.0
"""ArduPlane's: a missing item is asked for again each second; an upload without progress ends after 8 s."""

_ACCEPTED = mavlink.MAV_MISSION_ACCEPTED
_MISSION = mavlink.MAV_MISSION_TYPE_MISSION
_ALL = mavlink.MAV_MISSION_TYPE_ALL


@dataclass
class _Upload:
    """An upload that is running: the items so far are staged here, and the old mission is still the vehicle's."""

    station: Station
    count: int
    progress_at_s: float
    requested_at_s: float
    items: list[MissionItem] = field(default_factory=list)


@dataclass(frozen=True)
class _Ended:
    """How the last upload ended: a repeat of its last item gets the same MISSION_ACK, should that have been lost."""

    station: Station
    seq: int
    result: int


class MissionServer:
    """Serves one vehicle's mission to any number of stations. Feed it messages and ticks.

    Items are pulled in strict order with MISSION_REQUEST_INT, and the vehicle gets the new mission in one piece after
    the last of them. A station that starts a transfer ends its own earlier one; a second station is DENIED meanwhile.

    Args:
        vehicle: whose mission it is.
        send: puts a message on the wire to a peer.
        report: called with each StatusText that explains a refusal.
        now: wall time in seconds; only differences matter.
    """

    def __init__(
        self,
        vehicle: Vehicle,
        send: Send,
        report: Callable[[StatusText], None],
        now: Callable[[], float],
        *,
        request_again_s: float = REQUEST_AGAIN_S,
        give_up_s: float = GIVE_UP_S,
    ) -> None:
        self._vehicle = vehicle
        self._send = send
        self._report = report
        self._now = now
        self._request_again_s = request_again_s
        self._give_up_s = give_up_s
        self._upload: _Upload | None = None
        self._ended: _Ended | None = None
        self._downloads: dict[Station, Mission] = {}
        self._identified = (vehicle.mission, opaque_id(vehicle.mission))
        self._handlers: dict[str, Callable[[Message, Station], None]] = {
            "MISSION_COUNT": self._on_count,
            "MISSION_ITEM": self._on_item,
            "MISSION_ITEM_INT": self._on_item,
            "MISSION_REQUEST_LIST": self._on_request_list,
            "MISSION_REQUEST": self._on_request,
            "MISSION_REQUEST_INT": self._on_request,
            "MISSION_CLEAR_ALL": self._on_clear,
            "MISSION_ACK": self._on_ack,
            "MISSION_REQUEST_PARTIAL_LIST": self._on_unsupported,
            "MISSION_WRITE_PARTIAL_LIST": self._on_unsupported,
        }

    @property
    def opaque_id(self) -> int:
        """Id of the mission held; 0 = none."""
        mission, plan_id = self._identified
        if mission is not self._vehicle.mission:
            plan_id = opaque_id(self._vehicle.mission)
            self._identified = (self._vehicle.mission, plan_id)
        return plan_id

    def on_message(self, message: Message, peer: Peer) -> None:
        """Take one message; what is not of the mission protocol or not addressed to this very vehicle is ignored."""
        handler = self._handlers.get(message.get_type())
        if handler is None or message.target_system != self._vehicle.sysid:
            return
        station = Station.of(message, peer)
        supported = message.mission_type == _MISSION or (message.mission_type == _ALL and handler == self._on_clear)
        if supported:
            handler(message, station)
        elif handler != self._on_ack:
            self._on_unsupported(message, station)

    def on_tick(self) -> None:
        """Ask again for an item that does not come; give up in the end."""
        upload, now_s = self._upload, self._now()
        if upload is None:
            return
        if now_s - upload.progress_at_s >= self._give_up_s:
            self._warn(f"Mission upload timeout at item {len(upload.items)} of {upload.count}, old mission kept")
            self._end_upload(upload, len(upload.items), mavlink.MAV_MISSION_OPERATION_CANCELLED)
        elif now_s - upload.requested_at_s >= self._request_again_s:
            self._request_next(upload)

    def forget(self, peer: Peer) -> None:
        """A peer is gone: drop what was kept for its stations."""
        self._downloads = {station: held for station, held in self._downloads.items() if station.peer != peer}
        if self._upload is not None and self._upload.station.peer == peer:
            self._upload = None

    def _on_count(self, message: Message, station: Station) -> None:
        if self._busy_with_another(station):
            self._ack(station, mavlink.MAV_MISSION_DENIED)
        elif self._flying_it():
            self._warn("Mission upload refused in AUTO: switch to LOITER first")
            self._ack(station, mavlink.MAV_MISSION_DENIED)
        elif message.count > MAX_ITEMS:
            self._warn(f"Mission of {message.count} items refused: at most {MAX_ITEMS}")
            self._ack(station, mavlink.MAV_MISSION_NO_SPACE)
        elif message.count == 0:
            self._clear(station, _MISSION)
        else:
            self._ended = None
            self._upload = _Upload(station, message.count, self._now(), self._now())
            self._request_next(self._upload)

    def _on_item(self, message: Message, station: Station) -> None:
        upload = self._upload
        if upload is None or upload.station != station:
            self._on_item_without_upload(message.seq, station)
        elif message.seq == len(upload.items):
            self._take_item(upload, message)
        elif message.seq > len(upload.items):
            self._request_next(upload)

    def _on_item_without_upload(self, seq: int, station: Station) -> None:
        if self._busy_with_another(station):
            self._ack(station, mavlink.MAV_MISSION_DENIED)
        elif self._ended is None or self._ended.station != station or seq > self._ended.seq:
            self._ack(station, mavlink.MAV_MISSION_ERROR)
        elif seq == self._ended.seq:
            self._ack(station, self._ended.result)

    def _take_item(self, upload: _Upload, message: Message) -> None:
        item = self._vehicle.home if message.seq == 0 else check_item(message)
        if isinstance(item, int):
            self._warn(f"Mission item {message.seq} refused: {mavlink.enums['MAV_MISSION_RESULT'][item].name}")
            self._end_upload(upload, message.seq, item)
            return
        upload.items.append(item)
        upload.progress_at_s = self._now()
        if len(upload.items) < upload.count:
            self._request_next(upload)
            return
        try:
            self._vehicle.load(PlanType.MISSION, upload.items)
        except InputError as error:
            self._warn(str(error))
            self._end_upload(upload, message.seq, mavlink.MAV_MISSION_ERROR)
        else:
            self._end_upload(upload, message.seq, _ACCEPTED)

    def _end_upload(self, upload: _Upload, seq: int, result: int) -> None:
        self._upload = None
        self._ended = _Ended(upload.station, seq, result)
        self._ack(upload.station, result)

    def _request_next(self, upload: _Upload) -> None:
        upload.requested_at_s = self._now()
        peer, sysid, compid = upload.station
        self._send(mavlink.MAVLink_mission_request_int_message(sysid, compid, len(upload.items), _MISSION), peer)

    def _on_request_list(self, message: Message, station: Station) -> None:
        if self._busy_with_another(station):
            self._ack(station, mavlink.MAV_MISSION_DENIED)
            return
        self._end_own_upload(station)
        mission = self._vehicle.mission
        self._downloads[station] = mission
        count = MissionCount(station.sysid, station.compid, len(mission), _MISSION, self.opaque_id)
        self._send(count, station.peer)

    def _on_request(self, message: Message, station: Station) -> None:
        mission = self._downloads.get(station, self._vehicle.mission)
        if message.seq >= len(mission):
            self._ack(station, mavlink.MAV_MISSION_INVALID_SEQUENCE)
            return
        item = mission[message.seq]
        self._send(item_message(item, message.seq, station.sysid, station.compid), station.peer)

    def _on_clear(self, message: Message, station: Station) -> None:
        if self._busy_with_another(station):
            self._ack(station, mavlink.MAV_MISSION_DENIED, message.mission_type)
        elif self._flying_it():
            self._warn("Mission clear refused in AUTO: switch to LOITER first")
            self._ack(station, mavlink.MAV_MISSION_ERROR, message.mission_type)
        else:
            self._clear(station, message.mission_type)

    def _clear(self, station: Station, mission_type: int) -> None:
        self._end_own_upload(station)
        self._ended = None
        self._vehicle.load(PlanType.MISSION, (self._vehicle.home,))
        self._ack(station, _ACCEPTED, mission_type)

    def _on_ack(self, message: Message, station: Station) -> None:
        """The station ends a download, or cancels its upload."""
        self._downloads.pop(station, None)
        if message.type != _ACCEPTED:
            self._end_own_upload(station)

    def _on_unsupported(self, message: Message, station: Station) -> None:
        self._ack(station, mavlink.MAV_MISSION_UNSUPPORTED, message.mission_type)

    def _end_own_upload(self, station: Station) -> None:
        if self._upload is not None and self._upload.station == station:
            self._upload = None

    def _busy_with_another(self, station: Station) -> bool:
        return self._upload is not None and self._upload.station != station

    def _flying_it(self) -> bool:
        snapshot = self._vehicle.snapshot()
        return snapshot.airborne and snapshot.mode == Mode.AUTO

    def _ack(self, station: Station, result: int, mission_type: int = _MISSION) -> None:
        plan_id = self.opaque_id if result == _ACCEPTED else 0
        self._send(MissionAck(station.sysid, station.compid, result, mission_type, plan_id), station.peer)

    def _warn(self, text: str) -> None:
        self._report(StatusText(mavlink.MAV_SEVERITY_WARNING, text))
