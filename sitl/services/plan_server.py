"""The vehicle's plan of one type, given and taken with the MAVLink mission protocol."""

import math
from collections.abc import Callable, Iterable

from pymavlink.dialects.v20 import ardupilotmega as mavlink

from missions.errors import InputError
from missions.fence import parse_fence
from missions.mission import MissionItem
from missions.plan_type import PlanType
from sitl.events import StatusText
from sitl.modes import Mode
from sitl.services.ended_upload import EndedUpload
from sitl.services.item_rules import Refusal
from sitl.services.mission_items import check_item, item_message
from sitl.services.opaque_id import MissionAck, MissionCount, opaque_id
from sitl.services.peer import Message, Peer, Send, Station
from sitl.services.plan_upload import PlanUpload
from sitl.services.station_memory import StationMemory
from sitl.services.vehicle import Vehicle

MAX_ITEMS = {PlanType.MISSION: 700, PlanType.FENCE: 200, PlanType.RALLY: 100}
"""Largest plans held; of missions home included, of fences each vertex counts."""

_NAMES = {PlanType.MISSION: "Mission", PlanType.FENCE: "Fence", PlanType.RALLY: "Rally"}
_ACCEPTED = mavlink.MAV_MISSION_ACCEPTED


class PlanServer:
    """Serves one plan of one vehicle; MissionServer says to whom.

    Args:
        plan: its type.
        vehicle: whose plan it is.
        send: puts a message on the wire to a peer.
        report: called with each StatusText that explains a refusal.
        now: wall time in seconds; only differences matter.
        strict: stations known to upload in strict order only; those found to be so are added.
    """

    def __init__(
        self,
        plan: PlanType,
        vehicle: Vehicle,
        send: Send,
        report: Callable[[StatusText], None],
        now: Callable[[], float],
        strict: StationMemory[bool],
    ) -> None:
        self._plan = plan
        self._vehicle = vehicle
        self._send = send
        self._report = report
        self._now = now
        self._strict = strict
        self._upload: PlanUpload | None = None
        self._ended: EndedUpload | None = None
        self._downloads: StationMemory[tuple[MissionItem, ...]] = StationMemory()
        self._identified: tuple[tuple[MissionItem, ...], int] = ((), 0)

    @property
    def plan_id(self) -> int:
        """Opaque id of the plan held; 0 = none."""
        items = self._vehicle.items(self._plan)
        if items is not self._identified[0]:
            self._identified = (items, opaque_id(self._plan, items))
        return self._identified[1]

    @property
    def uploader(self) -> Station | None:
        """The station that uploads, if one does."""
        return None if self._upload is None else self._upload.station

    @property
    def deadline_s(self) -> float:
        """When `on_tick` has something to do."""
        return min((of.deadline_s for of in (self._upload, self._ended) if of is not None), default=math.inf)

    def on_tick(self) -> None:
        """Ask again for items that do not come; give up in the end."""
        ended, upload = self._ended, self._upload
        if ended is not None and self._now() >= ended.deadline_s:
            self._send(ended.ask_again(), ended.station.peer)
        if upload is None or self._now() < upload.deadline_s:
            return
        if self._now() < upload.gives_up_at_s:
            self._tell(upload, upload.overdue())
            return
        seq = upload.window.lowest
        self._warn(f"{self._name} upload timeout at item {seq} of {upload.count}, old one kept")
        self._end(upload, EndedUpload(upload.station, seq, upload.last, mavlink.MAV_MISSION_OPERATION_CANCELLED))

    def forget(self, peer: Peer) -> None:
        """A peer is gone: drop what was kept for its stations."""
        self._downloads.forget(peer)
        if self._upload is not None and self._upload.station.peer == peer:
            self._upload = None
        if self._ended is not None and self._ended.station.peer == peer:
            self._ended = None

    def moved_on(self, station: Station) -> None:
        """A station has begun something else than the upload that has ended: it knows how, or no longer cares."""
        if self._ended is not None and self._ended.station == station:
            self._ended.rest()

    def on_count(self, message: Message, station: Station) -> None:
        """MISSION_COUNT: an upload of the whole plan begins, or begins anew."""
        limit = MAX_ITEMS[self._plan]
        if self._refused_in_flight("upload", mavlink.MAV_MISSION_DENIED, station):
            return
        if message.count > limit:
            self._end_own_upload(station)
            self._warn(f"{self._name} of {message.count} items refused: at most {limit} items")
            self._ack(station, mavlink.MAV_MISSION_NO_SPACE)
        elif message.count == 0:
            self._ack(station, self.clear(station))
        else:
            self._begin(station, [None] * message.count, 0, message.count - 1)

    def on_write_partial_list(self, message: Message, station: Station) -> None:
        """MISSION_WRITE_PARTIAL_LIST: an upload of a stretch of the plan held begins."""
        held, first, last = self._vehicle.items(self._plan), message.start_index, message.end_index
        if self._refused_in_flight("upload", mavlink.MAV_MISSION_DENIED, station):
            return
        if 0 <= first <= last < len(held):
            self._begin(station, held, first, last)
        else:
            self._warn(f"{self._name} items {first} to {last} cannot be replaced: {len(held)} items are held")
            self._ack(station, mavlink.MAV_MISSION_ERROR)

    def on_item(self, message: Message, station: Station) -> None:
        """MISSION_ITEM_INT or MISSION_ITEM: one item of an upload."""
        upload, seq = self._upload, message.seq
        if upload is None or upload.station != station:
            self._take_stray(seq, station)
        elif upload.window.wants(seq):
            self._take(upload, message)
        elif upload.window.has(seq):
            upload.window.receive(seq)
            self._tell(upload, upload.requests())
        else:
            self._tell(upload, upload.ask_again())

    def on_request_list(self, message: Message, station: Station) -> None:
        """MISSION_REQUEST_LIST: a download begins; it stays one of the plan held now, whatever is uploaded."""
        self._end_own_upload(station)
        items = self._vehicle.items(self._plan)
        self._downloads.put(station, items)
        count = MissionCount(station.sysid, station.compid, len(items), int(self._plan), self.plan_id)
        self._send(count, station.peer)

    def on_request(self, message: Message, station: Station) -> None:
        """MISSION_REQUEST_INT or MISSION_REQUEST: any item, in any order, with a download or without one."""
        self._give(station, message.seq, message.seq)

    def on_request_partial_list(self, message: Message, station: Station) -> None:
        """MISSION_REQUEST_PARTIAL_LIST: a stretch of items, sent one after the other; an end of -1 is the last."""
        last = message.end_index if message.end_index != -1 else len(self._offered(station)) - 1
        self._give(station, message.start_index, last)

    def on_ack(self, message: Message, station: Station) -> None:
        """MISSION_ACK: the station ends a download, cancels its upload, or complains of our requests."""
        upload = self._upload
        if upload is None or upload.station != station:
            self._downloads.drop(station)
        elif message.type == mavlink.MAV_MISSION_INVALID_SEQUENCE:
            upload.window.fall_back()
            self._tell(upload, upload.requests())
        elif message.type == mavlink.MAV_MISSION_UNSUPPORTED:
            self._tell(upload, upload.refuse_old_requests())
        elif message.type != _ACCEPTED:
            self._upload = None

    def flying_it(self) -> bool:
        """Whether the plan is what the vehicle flies: then it is neither replaced nor cleared."""
        if self._plan != PlanType.MISSION:
            return False
        snapshot = self._vehicle.snapshot()
        return snapshot.airborne and snapshot.mode == Mode.AUTO

    def clear(self, station: Station) -> int:
        """Leave nothing but home; the MAV_MISSION_RESULT."""
        self._end_own_upload(station)
        self._ended = None
        refused = self._load((self._vehicle.home,) if self._plan == PlanType.MISSION else ())
        return _ACCEPTED if refused is None else refused.result

    @property
    def _name(self) -> str:
        return _NAMES[self._plan]

    def _begin(self, station: Station, base: Iterable[MissionItem | None], first: int, last: int) -> None:
        """Ask for the first item; the other way, if the station begins again without having answered the one."""
        earlier = self._upload
        self._ended = None
        self._upload = PlanUpload(
            self._plan,
            station,
            base,
            first,
            last,
            self._now,
            strict=self._strict.get(station) is not None,
            old_requests=earlier is not None and earlier.unheard_requests is False,
            asked_before=frozenset() if earlier is None else earlier.window.asked,
        )
        self._tell(self._upload, self._upload.requests())

    def _take(self, upload: PlanUpload, message: Message) -> None:
        """Stage an item that was asked for, and with the last one take over the plan."""
        seq = message.seq
        home = seq == 0 and self._plan == PlanType.MISSION
        item = self._vehicle.home if home else check_item(message, self._plan, upload.count)
        if isinstance(item, Refusal):
            self._warn(f"{self._name} item {seq} refused: {item.reason}")
            self._conclude(upload, seq, item.result)
            return
        upload.take(seq, item)
        if not upload.window.complete:
            self._tell(upload, upload.requests())
            return
        refused = self._load(upload.whole())
        self._conclude(upload, seq, _ACCEPTED if refused is None else refused.result)

    def _load(self, items: tuple[MissionItem, ...]) -> Refusal | None:
        """Give the vehicle a whole plan; when it is refused, the reason has been told."""
        refused = None
        if self.flying_it():
            refused = Refusal(mavlink.MAV_MISSION_DENIED, f"{self._name} is being flown: switch to LOITER first")
        else:
            try:
                if self._plan == PlanType.FENCE:
                    parse_fence(items)
                self._vehicle.load(self._plan, items)
            except InputError as error:
                refused = Refusal(mavlink.MAV_MISSION_ERROR, str(error))
        if refused is not None:
            self._warn(refused.reason)
        return refused

    def _conclude(self, upload: PlanUpload, seq: int, result: int) -> None:
        if upload.strict:
            self._strict.put(upload.station, True)
        on_the_way = set(upload.window.outstanding - {seq})
        # For item 0, a station that has begun another upload would give that one's item.
        question = upload.request(seq) if seq > 0 else None
        self._end(upload, EndedUpload(upload.station, seq, upload.last, result, on_the_way, question, self._now()))

    def _end(self, upload: PlanUpload, ended: EndedUpload) -> None:
        self._upload = None
        self._ended = ended
        for _ in range(upload.window.copies):
            self._ack(upload.station, ended.result)

    def _take_stray(self, seq: int, station: Station) -> None:
        """An item without an upload: of one that has ended, or of none."""
        ended = self._ended
        if self._upload is not None:
            self._ack(station, mavlink.MAV_MISSION_DENIED)
        elif ended is None or ended.station != station or seq > ended.last:
            self._ack(station, mavlink.MAV_MISSION_ERROR)
        elif ended.answers(seq):
            self._ack(station, ended.result)

    def _give(self, station: Station, first: int, last: int) -> None:
        """Send a stretch of items."""
        items = self._offered(station)
        if not 0 <= first <= last < len(items):
            self._ack(station, mavlink.MAV_MISSION_INVALID_SEQUENCE)
            return
        for seq in range(first, last + 1):
            self._send(item_message(items[seq], seq, station.sysid, station.compid, self._plan), station.peer)

    def _offered(self, station: Station) -> tuple[MissionItem, ...]:
        """The plan that a station downloads."""
        items = self._downloads.get(station)
        return self._vehicle.items(self._plan) if items is None else items

    def _refused_in_flight(self, what: str, result: int, station: Station) -> bool:
        if not self.flying_it():
            return False
        self._end_own_upload(station)  # given up for what is refused
        self._warn(f"{self._name} {what} refused in AUTO: switch to LOITER first")
        self._ack(station, result)
        return True

    def _end_own_upload(self, station: Station) -> None:
        if self._upload is not None and self._upload.station == station:
            self._upload = None

    def _tell(self, upload: PlanUpload, messages: list[Message]) -> None:
        for message in messages:
            self._send(message, upload.station.peer)

    def _ack(self, station: Station, result: int) -> None:
        plan_id = self.plan_id if result == _ACCEPTED else 0
        self._send(MissionAck(station.sysid, station.compid, result, int(self._plan), plan_id), station.peer)

    def _warn(self, text: str) -> None:
        self._report(StatusText(mavlink.MAV_SEVERITY_WARNING, text))
