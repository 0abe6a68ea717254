"""The vehicle's end of the MAVLink mission protocol: its mission, fence and rally points."""

from collections.abc import Callable

from pymavlink.dialects.v20 import ardupilotmega as mavlink

from missions.plan_type import HELD, PlanType
from sitl.events import StatusText
from sitl.services.opaque_id import MissionAck
from sitl.services.peer import Message, Peer, Send, Station
from sitl.services.plan_server import PlanServer
from sitl.services.station_memory import StationMemory
from sitl.services.vehicle import Vehicle

Handler = Callable[[PlanServer, Message, Station], None]

_GIVING: dict[str, Handler] = {
    "MISSION_COUNT": PlanServer.on_count,
    "MISSION_WRITE_PARTIAL_LIST": PlanServer.on_write_partial_list,
}
"""What begins an upload: not while another station uploads a plan of any type."""

_LIST = "MISSION_REQUEST_LIST"
"""What begins a download: not while another station uploads a plan of the same type."""

_ITEMS = frozenset({"MISSION_ITEM", "MISSION_ITEM_INT"})

_OTHERS: dict[str, Handler] = {
    _LIST: PlanServer.on_request_list,
    "MISSION_ITEM": PlanServer.on_item,
    "MISSION_ITEM_INT": PlanServer.on_item,
    "MISSION_REQUEST": PlanServer.on_request,
    "MISSION_REQUEST_INT": PlanServer.on_request,
    "MISSION_REQUEST_PARTIAL_LIST": PlanServer.on_request_partial_list,
    "MISSION_ACK": PlanServer.on_ack,
}

_CLEAR = "MISSION_CLEAR_ALL"
_KINDS = frozenset({*_GIVING, *_OTHERS, _CLEAR})


class MissionServer:
    """Serves one vehicle's plans to any number of stations. Feed it messages and ticks.

    A plan held stays in force until the new one is whole and kept. A station that begins an upload ends its own earlier
    one of that type; a second station is DENIED meanwhile.

    Args:
        vehicle: whose plans they are.
        send: puts a message on the wire to a peer.
        report: called with each StatusText that explains a refusal.
        now: wall time in seconds; only differences matter.
    """

    def __init__(
        self, vehicle: Vehicle, send: Send, report: Callable[[StatusText], None], now: Callable[[], float]
    ) -> None:
        self._vehicle = vehicle
        self._send = send
        self._report = report
        self._strict: StationMemory[bool] = StationMemory()
        self._servers = {plan: PlanServer(plan, vehicle, send, report, now, self._strict) for plan in HELD}

    @property
    def plan_ids(self) -> tuple[int, int, int]:
        """Opaque ids of mission, fence and rally points; 0 = none."""
        mission_id, fence_id, rally_id = (self._servers[plan].plan_id for plan in HELD)
        return mission_id, fence_id, rally_id

    @property
    def deadline_s(self) -> float:
        """When `on_tick` has something to do; infinite while there is no upload."""
        return min(server.deadline_s for server in self._servers.values())

    def on_message(self, message: Message, peer: Peer) -> None:
        """Take one message; what is not of the mission protocol or is addressed to another vehicle is ignored."""
        kind = message.get_type()
        if kind not in _KINDS or message.target_system not in (0, self._vehicle.sysid):
            return
        station = Station.of(message, peer)
        if kind not in _ITEMS:
            for one in self._servers.values():
                one.moved_on(station)
        server = self._servers.get(message.mission_type)
        if kind == _CLEAR and (server is not None or message.mission_type == PlanType.ALL):
            self._on_clear(message.mission_type, station)
        elif server is None:
            if kind != "MISSION_ACK":
                self._ack(station, mavlink.MAV_MISSION_UNSUPPORTED, message.mission_type)
        elif kind in _GIVING:
            if self._busy_with_another(station):
                self._ack(station, mavlink.MAV_MISSION_DENIED, message.mission_type)
            else:
                _GIVING[kind](server, message, station)
        elif kind == _LIST and server.uploader not in (None, station):
            self._ack(station, mavlink.MAV_MISSION_DENIED, message.mission_type)
        else:
            _OTHERS[kind](server, message, station)

    def on_tick(self) -> None:
        """Ask again for items that do not come; give up in the end."""
        for server in self._servers.values():
            server.on_tick()

    def forget(self, peer: Peer) -> None:
        """A peer is gone: drop what was kept for its stations."""
        self._strict.forget(peer)
        for server in self._servers.values():
            server.forget(peer)

    def _on_clear(self, mission_type: int, station: Station) -> None:
        plans = HELD if mission_type == PlanType.ALL else (PlanType(mission_type),)
        servers = [self._servers[plan] for plan in plans]
        if self._busy_with_another(station):
            self._ack(station, mavlink.MAV_MISSION_DENIED, mission_type)
        elif any(server.flying_it() for server in servers):
            text = "Mission clear refused in AUTO: switch to LOITER first"
            self._report(StatusText(mavlink.MAV_SEVERITY_WARNING, text))
            self._ack(station, mavlink.MAV_MISSION_ERROR, mission_type)
        else:
            results = [server.clear(station) for server in servers]
            self._ack(station, max(results), mission_type)

    def _busy_with_another(self, station: Station) -> bool:
        return any(server.uploader not in (None, station) for server in self._servers.values())

    def _ack(self, station: Station, result: int, mission_type: int) -> None:
        """MISSION_ACK; the id after clearing is that of no plan, as it is with every refusal."""
        self._send(MissionAck(station.sysid, station.compid, result, mission_type, 0), station.peer)
