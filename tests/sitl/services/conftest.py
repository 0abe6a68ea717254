"""A vehicle's face on the bench, without a socket."""

from collections.abc import Callable
from typing import Any

import pytest
from pymavlink.dialects.v20 import ardupilotmega as mavlink

from missions.mission import MissionItem
from missions.plan_type import PlanType
from sitl.events import StatusText
from sitl.services.codec import Codec
from sitl.services.face import MavlinkFace
from sitl.services.mission_items import item_message
from sitl.services.mission_server import MissionServer
from sitl.services.peer import Peer

PLAN_PEER, PLAN_SYSID = Peer("udp", "127.0.0.1", 14550), 3
PEER, OTHER = Peer("tcp", "127.0.0.1", 1000), Peer("udp", "127.0.0.1", 1001)


class Bench:
    """A face, its vehicle, a clock, and one station on each of two peers."""

    peer, other = PEER, OTHER

    def __init__(self, vehicle: Any, frame: Any) -> None:
        self.vehicle = vehicle
        self.time_s = 50.0
        self.codecs = {peer: Codec(255, 190) for peer in (PEER, OTHER)}
        self.pieces: dict[Peer, list[bytes]] = {PEER: [], OTHER: []}
        self.face = MavlinkFace(vehicle, frame, self._send, lambda: self.time_s, epoch_s=1.7e9)
        for peer in (PEER, OTHER):
            self.face.add_peer(peer)

    def _send(self, peer: Peer, data: bytes) -> None:
        self.pieces[peer].append(data)

    def heard(self, peer: Peer = PEER) -> list[Any]:
        """What has come to a peer since the last call."""
        data, self.pieces[peer] = b"".join(self.pieces[peer]), []
        return self.codecs[peer].feed(data)

    def tell(self, message: Any) -> list[Any]:
        self.heard()
        self.face.on_bytes(self.codecs[PEER].pack(message), PEER)
        return self.heard()

    def tick(self, seconds: float = 0.0) -> list[Any]:
        self.heard()
        self.time_s += seconds
        self.face.on_tick()
        return self.heard()

    def refused(self, number: int, *params: float) -> tuple[int, str]:
        """The result and the line that explains it."""
        result, texts = self.command(number, *params)
        return result, "".join(text.text for text in texts)

    def command_int(self, number: int, params: tuple[float, ...], place: tuple[int, int, float], frame: int = 3) -> Any:
        """Send COMMAND_INT; the result, and the texts that explain it."""
        four = params + (0.0,) * (4 - len(params))
        *texts, ack = self.tell(mavlink.MAVLink_command_int_message(3, 1, frame, number, 0, 0, *four, *place))
        return ack.result, [text.text for text in texts]

    def command(self, number: int, *params: float) -> tuple[int, list[Any]]:
        """Send COMMAND_LONG and COMMAND_INT; the result, which must agree, and what else came after the former."""
        seven = params + (0.0,) * (7 - len(params))
        *others, ack = self.tell(mavlink.MAVLink_command_long_message(3, 1, number, 1, *seven))
        *_, ack_int = self.tell(mavlink.MAVLink_command_int_message(3, 1, 0, number, 0, 0, *seven[:4], 0, 0, seven[6]))
        assert ack.get_type() == ack_int.get_type() == "COMMAND_ACK"
        assert (ack.command, ack.target_system, ack.target_component) == (number, 255, 190)
        assert ack_int.result == ack.result
        return ack.result, others


@pytest.fixture
def bench(make_vehicle: Any, make_mission: Callable[[int], Any], frame: Any) -> Bench:
    vehicle = make_vehicle(3)
    vehicle.mission = make_mission(5)
    return Bench(vehicle, frame)


class PlanBench:
    """A mission server, its vehicle, a clock, and all it says."""

    def __init__(self, vehicle: Any) -> None:
        self.vehicle = vehicle
        self.time_s = 0.0
        self.sent: list[tuple[Any, Peer]] = []
        self.texts: list[StatusText] = []
        self.server = MissionServer(
            vehicle, lambda message, peer: self.sent.append((message, peer)), self.texts.append, lambda: self.time_s
        )

    def tell(self, message: Any, peer: Peer = PLAN_PEER, sysid: int = 255) -> list[Any]:
        """Feed one message over the wire; what the server says to that peer at once."""
        before = len(self.sent)
        for received in Codec(1, 1).feed(Codec(sysid, 190).pack(message)):
            self.server.on_message(received, peer)
        assert all(to == peer for _, to in self.sent[before:])
        return [answer for answer, _ in self.sent[before:]]

    def count(self, count: int, plan: int = PlanType.MISSION, **kwargs: Any) -> list[Any]:
        return self.tell(mavlink.MAVLink_mission_count_message(PLAN_SYSID, 1, count, plan), **kwargs)

    def item(self, items: Any, seq: int, plan: PlanType = PlanType.MISSION, **kwargs: Any) -> list[Any]:
        return self.tell(item_message(items[seq], seq, PLAN_SYSID, 1, plan), **kwargs)

    def raw_item(self, seq: int, item: MissionItem, plan: int = PlanType.MISSION, **kwargs: Any) -> list[Any]:
        fields = (
            PLAN_SYSID,
            1,
            seq,
            item.frame,
            item.command,
            0,
            1,
            *item.params,
            item.lat_e7,
            item.lon_e7,
            item.alt_m,
        )
        return self.tell(mavlink.MAVLink_mission_item_int_message(*fields, plan), **kwargs)

    def ack(self, result: int, plan: int = PlanType.MISSION, **kwargs: Any) -> list[Any]:
        return self.tell(mavlink.MAVLink_mission_ack_message(PLAN_SYSID, 1, result, plan), **kwargs)

    def write_partial(self, first: int, last: int, plan: int = PlanType.MISSION, **kwargs: Any) -> list[Any]:
        message = mavlink.MAVLink_mission_write_partial_list_message(PLAN_SYSID, 1, first, last, plan)
        return self.tell(message, **kwargs)

    def list_plan(self, plan: int = PlanType.MISSION, **kwargs: Any) -> list[Any]:
        return self.tell(mavlink.MAVLink_mission_request_list_message(PLAN_SYSID, 1, plan), **kwargs)

    def clear(self, plan: int = PlanType.MISSION, **kwargs: Any) -> list[Any]:
        return self.tell(mavlink.MAVLink_mission_clear_all_message(PLAN_SYSID, 1, plan), **kwargs)

    def upload(self, items: Any, plan: PlanType = PlanType.MISSION, **kwargs: Any) -> list[Any]:
        """Answer every request in turn; what the server says in the end."""
        return self.answer(items, self.count(len(items), plan, **kwargs), plan, **kwargs)

    def answer(self, items: Any, asked: list[Any], plan: PlanType = PlanType.MISSION, **kwargs: Any) -> list[Any]:
        while asked and all(message.get_type() == "MISSION_REQUEST_INT" for message in asked):
            asked = asked[1:] + self.item(items, asked[0].seq, plan, **kwargs)
        return asked

    def wait(self, seconds: float) -> list[Any]:
        """What the server says when so much time has passed at once."""
        self.time_s += seconds
        before = len(self.sent)
        self.server.on_tick()
        return [answer for answer, _ in self.sent[before:]]

    @staticmethod
    def results(answers: list[Any]) -> list[int]:
        """The MAV_MISSION_RESULTs of answers that are acknowledgements, all of them."""
        assert all(answer.get_type() == "MISSION_ACK" for answer in answers)
        return [answer.type for answer in answers]

    @staticmethod
    def requested(answers: list[Any]) -> list[int]:
        """The items asked for by answers that are requests, all of them."""
        assert all(answer.get_type() in ("MISSION_REQUEST_INT", "MISSION_REQUEST") for answer in answers)
        return [answer.seq for answer in answers]


@pytest.fixture
def plan_bench(make_vehicle: Any) -> PlanBench:
    return PlanBench(make_vehicle(PLAN_SYSID))
