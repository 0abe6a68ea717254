"""What the station does with a vehicle's plans, and with many vehicles at once."""

import asyncio
from collections.abc import Callable
from typing import Any

import pytest
from pymavlink.dialects.v20 import ardupilotmega as mavlink

from gcs.transfers.errors import TransferError
from gcs.transfers.for_all import for_all
from gcs.transfers.plans import clear, download, upload_and_verify
from gcs.vehicle_link import VehicleLink
from missions.fence import Fence, FenceCircle, fence_items
from missions.plan_type import HELD, PlanType
from sitl.services.codec import Codec
from sitl.services.mission_server import MissionServer
from sitl.services.peer import Peer

PEER = Peer("udp", "127.0.0.1", 14550)
FENCE = fence_items(Fence((FenceCircle(True, (465_000_000, 113_000_000), 300.0),)))


class Linked:
    """A vehicle's server at the other end of a VehicleLink, each message delivered in a turn of its own.

    Args:
        vehicle: whose plans are served.
        heard: called with each message's kind on its way to the vehicle, whether it gets there.
    """

    def __init__(self, vehicle: Any, heard: Callable[[str], bool] = lambda kind: True) -> None:
        self.sent: list[Any] = []
        self._heard = heard
        self._ours, self._theirs = Codec(255, 190), Codec(vehicle.sysid, 1)
        loop = asyncio.get_running_loop()
        self.link = VehicleLink(vehicle.sysid, 1, PEER, self._send)
        self._server = MissionServer(
            vehicle, lambda message, _: loop.call_soon(self._receive, message), lambda status: None, loop.time
        )

    def heartbeat(self, kind: int, autopilot: int = mavlink.MAV_AUTOPILOT_ARDUPILOTMEGA) -> None:
        self._receive(mavlink.MAVLink_heartbeat_message(kind, autopilot, 0, 0, 3, 3))

    def _send(self, message: Any) -> bytes:
        self.sent.append(message)
        frame = self._ours.pack(message)
        if self._heard(message.get_type()):
            for received in self._theirs.feed(frame):
                self._server.on_message(received, PEER)
        return frame

    def _receive(self, message: Any) -> None:
        for received in self._ours.feed(self._theirs.pack(message)):
            self.link.on_message(received)


def test_plans_of_each_type_are_brought_read_and_cleared(make_vehicle: Any, make_mission: Any) -> None:
    vehicle = make_vehicle(3)

    async def main() -> None:
        link = Linked(vehicle).link
        mission = make_mission(30).items
        assert await upload_and_verify(link, PlanType.MISSION, mission) == 30
        assert await upload_and_verify(link, PlanType.FENCE, FENCE) == 1
        assert await download(link, PlanType.MISSION) == mission
        assert await download(link, PlanType.FENCE) == FENCE
        await clear(link, PlanType.ALL)
        assert [len(vehicle.items(plan)) for plan in HELD] == [1, 0, 0]

    asyncio.run(main())


def test_who_is_no_plane_gets_nothing(make_vehicle: Any, make_mission: Any) -> None:
    async def main() -> None:
        linked = Linked(make_vehicle(3))
        linked.heartbeat(mavlink.MAV_TYPE_QUADROTOR)
        with pytest.raises(TransferError, match="vehicle 3: is a MAV_TYPE_QUADROTOR, and gets no mission"):
            await upload_and_verify(linked.link, PlanType.MISSION, make_mission(3))
        assert linked.sent == []
        linked.heartbeat(mavlink.MAV_TYPE_VTOL_TILTROTOR)
        assert await upload_and_verify(linked.link, PlanType.MISSION, make_mission(3)) == 3

    asyncio.run(main())


def test_what_mavlink_cannot_count_is_refused_before_it_is_sent(make_vehicle: Any) -> None:
    async def main() -> None:
        linked = Linked(make_vehicle(3))
        with pytest.raises(TransferError, match="vehicle 3: 65536 items are more than MAVLink can count"):
            await upload_and_verify(linked.link, PlanType.FENCE, FENCE * 65536)
        assert linked.sent == []

    asyncio.run(main())


def test_a_plan_that_slipped_in_meanwhile_is_replaced(make_vehicle: Any, make_mission: Any) -> None:
    vehicle = make_vehicle(3)
    wanted, other = make_mission(9).items, make_mission(5).items
    loads: list[int] = []
    load = vehicle.load

    def load_another_first(plan: PlanType, items: Any) -> None:
        loads.append(len(items))
        load(plan, other if len(loads) == 1 else items)

    vehicle.load = load_another_first

    async def main() -> None:
        assert await upload_and_verify(Linked(vehicle).link, PlanType.MISSION, wanted) == 9

    asyncio.run(main())
    assert loads == [9, 9]
    assert vehicle.mission.items == wanted


def test_a_cancelled_upload_tells_the_vehicle_and_a_second_try_starts_clean(
    make_vehicle: Any, make_mission: Any
) -> None:
    vehicle = make_vehicle(3)
    through = True

    async def main() -> None:
        nonlocal through
        linked = Linked(vehicle, lambda kind: through or kind not in ("MISSION_COUNT", "MISSION_ITEM_INT"))
        through = False
        upload = asyncio.create_task(upload_and_verify(linked.link, PlanType.MISSION, make_mission(9)))
        while not linked.sent:
            await asyncio.sleep(0)
        upload.cancel()
        with pytest.raises(asyncio.CancelledError):
            await upload
        assert linked.sent[-1].get_type() == "MISSION_ACK"
        assert linked.sent[-1].type == mavlink.MAV_MISSION_OPERATION_CANCELLED
        assert not linked.link.transfer_lock.locked()
        through = True
        assert await upload_and_verify(linked.link, PlanType.MISSION, make_mission(9)) == 9

    asyncio.run(main())


def test_the_failure_of_one_vehicle_stops_no_other(make_vehicle: Any, make_mission: Any) -> None:
    async def main() -> None:
        linked = {sysid: Linked(make_vehicle(sysid)) for sysid in (1, 2, 3)}
        linked[2].heartbeat(mavlink.MAV_TYPE_GROUND_ROVER)
        results = await for_all(
            [one.link for one in linked.values()],
            lambda vehicle: upload_and_verify(vehicle, PlanType.MISSION, make_mission(5)),
        )
        assert list(results) == [1, 2, 3]
        assert results[1] == results[3] == 5
        assert isinstance(results[2], TransferError)
        assert str(results[2]).startswith("vehicle 2: is a MAV_TYPE_GROUND_ROVER")

    asyncio.run(main())
