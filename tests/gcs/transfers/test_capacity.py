"""How many items a vehicle takes, from its refusal of too many."""

import asyncio
import itertools
from typing import Any

import pytest
from pymavlink.dialects.v20 import ardupilotmega as mavlink

from gcs.transfers import capacity as module
from gcs.transfers.capacity import capacities, capacity
from gcs.vehicle_link import VehicleLink
from missions.plan_type import PlanType
from sitl.events import StatusText
from sitl.services.codec import Codec
from sitl.services.mission_server import MissionServer
from sitl.services.peer import Peer
from sitl.services.status_text import status_text_messages

PEER = Peer("udp", "127.0.0.1", 14550)
US = (255, 190)
NO_SPACE = mavlink.MAVLink_mission_ack_message(*US, mavlink.MAV_MISSION_NO_SPACE)
DENIED = mavlink.MAVLink_mission_ack_message(*US, mavlink.MAV_MISSION_DENIED)


def said(text: str) -> Any:
    return mavlink.MAVLink_statustext_message(4, text.encode())


class Answering:
    """A vehicle that says the same at each MISSION_COUNT; to be made in a running loop."""

    def __init__(self, *answers: Any) -> None:
        self.sent: list[Any] = []
        self.link = VehicleLink(3, 1, PEER, self._send)
        self._answers, self._loop = answers, asyncio.get_running_loop()
        self._ours, self._theirs = Codec(*US), Codec(3, 1)

    def hear(self, message: Any) -> None:
        for received in self._ours.feed(self._theirs.pack(message)):
            self.link.on_message(received)

    def _send(self, message: Any) -> bytes:
        self.sent.append(message)
        if message.get_type() == "MISSION_COUNT":
            for answer in self._answers:
                self._loop.call_soon(self.hear, answer)
        return self._ours.pack(message)


@pytest.mark.parametrize(
    ("answers", "limit"),
    [
        ((NO_SPACE, said("Only 655 items are supported")), 655),
        ((said("mission of 65535 items refused: at most 700 items"), NO_SPACE), 700),
        ((NO_SPACE, said("Only 0 items are supported")), None),
        ((NO_SPACE, said("wind is up")), None),
        ((DENIED, said("Only 655 items are supported")), None),
    ],
)
def test_the_limit_is_what_the_refusal_says_in_whatever_order(
    answers: tuple[Any, ...], limit: int | None, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(module, "TEXT_S", 0.05)

    async def main() -> None:
        assert await capacity(Answering(*answers).link, PlanType.MISSION) == limit

    asyncio.run(main())


def test_who_takes_so_many_is_told_to_stop_and_has_said_nothing() -> None:
    async def main() -> None:
        vehicle = Answering(mavlink.MAVLink_mission_request_int_message(*US, 0))
        assert await capacity(vehicle.link, PlanType.MISSION) is None
        assert [message.get_type() for message in vehicle.sent] == ["MISSION_COUNT", "MISSION_ACK"]
        assert vehicle.sent[-1].type == mavlink.MAV_MISSION_OPERATION_CANCELLED

    asyncio.run(main())


def test_an_endpoint_says_it_of_all_three_plans_and_holds_what_it_held(make_vehicle: Any, make_mission: Any) -> None:
    vehicle = make_vehicle(3)
    vehicle.mission = make_mission(9)

    async def main() -> None:
        loop, ids = asyncio.get_running_loop(), itertools.count(1)
        station, theirs = Answering(), Codec(3, 1)

        def tell(status: StatusText) -> None:
            for piece in status_text_messages(status, next(ids)):
                loop.call_soon(station.hear, piece)

        server = MissionServer(vehicle, lambda message, _: loop.call_soon(station.hear, message), tell, loop.time)

        def send(message: Any) -> bytes:
            frame = Codec(*US).pack(message)
            for received in theirs.feed(frame):
                server.on_message(received, PEER)
            return frame

        station.link.move_to(PEER, send)
        assert await capacities(station.link) == {PlanType.MISSION: 700, PlanType.FENCE: 200, PlanType.RALLY: 100}

    asyncio.run(main())
    assert vehicle.mission == make_mission(9)
