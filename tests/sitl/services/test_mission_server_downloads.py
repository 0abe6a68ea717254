"""What is true of the vehicle's end of downloads, of stretches of a plan, and of clearing, fed by hand."""

from collections.abc import Callable
from typing import Any

import pytest
from pymavlink.dialects.v20 import ardupilotmega as mavlink

from missions.commands import Command
from missions.fence import Fence, FenceCircle, FencePolygon, fence_items, rally_items
from missions.mission import MissionItem
from missions.plan_type import PlanType
from sitl.services.mission_items import decode_item
from sitl.services.opaque_id import opaque_id
from sitl.services.peer import Peer
from sitl.services.station_memory import MAX_STATIONS

PEER = Peer("udp", "127.0.0.1", 14550)
OTHER_PEER = Peer("tcp", "127.0.0.1", 40000)
SYSID = 3
MISSION, FENCE, RALLY, ALL = PlanType.MISSION, PlanType.FENCE, PlanType.RALLY, PlanType.ALL
ACCEPTED, DENIED, ERROR = mavlink.MAV_MISSION_ACCEPTED, mavlink.MAV_MISSION_DENIED, mavlink.MAV_MISSION_ERROR

A_FENCE = fence_items(
    Fence(
        (FencePolygon(True, ((0, 0), (0, 10**6), (10**6, 10**6), (10**6, 0))), FenceCircle(False, (3, 4), 50.0)),
        return_point=(5, 6),
    )
)
SOME_RALLY = rally_items([(1, 2, 100.0), (3, 4, 120.0), (5, 6, 90.0)])
OTHERS = [(FENCE, A_FENCE), (RALLY, SOME_RALLY)]


@pytest.fixture
def bench(plan_bench: Any) -> Any:
    return plan_bench


@pytest.mark.parametrize(
    "request_item", [mavlink.MAVLink_mission_request_message, mavlink.MAVLink_mission_request_int_message]
)
def test_a_download_gives_the_items_in_any_order_with_both_requests(
    bench: Any, make_mission: Any, request_item: Callable[..., Any]
) -> None:
    mission = make_mission(7)
    bench.upload(mission)
    (count,) = bench.list_plan()
    assert (count.count, count.opaque_id) == (7, opaque_id(MISSION, mission))
    for seq in (6, 0, 3, 3, 5, 1, 2, 4):
        (item,) = bench.tell(request_item(SYSID, 1, seq, 0))
        assert (item.get_type(), item.seq, item.current) == ("MISSION_ITEM_INT", seq, int(seq == 1))
        assert decode_item(item) == mission[seq]
    assert bench.results(bench.tell(request_item(SYSID, 1, 7, 0))) == [mavlink.MAV_MISSION_INVALID_SEQUENCE]
    assert bench.ack(ACCEPTED) == []


def test_a_download_stays_of_one_mission_while_another_is_uploaded(bench: Any, make_mission: Any) -> None:
    old, new = make_mission(7), make_mission(5)
    bench.upload(old)
    bench.list_plan(peer=OTHER_PEER)
    bench.upload(new.with_home(new[1]))
    (item,) = bench.tell(mavlink.MAVLink_mission_request_int_message(SYSID, 1, 6, 0), peer=OTHER_PEER)
    assert decode_item(item) == old[6]


def test_downloads_that_nobody_ends_are_bounded(bench: Any, make_mission: Any) -> None:
    bench.upload(make_mission(7))
    for compid in range(3 * MAX_STATIONS):
        bench.list_plan(peer=Peer("udp", "127.0.0.1", 20000 + compid))
    bench.upload(make_mission(3))
    old, late = (Peer("udp", "127.0.0.1", 20000 + number) for number in (0, 3 * MAX_STATIONS - 1))
    ask = mavlink.MAVLink_mission_request_int_message(SYSID, 1, 6, 0)
    assert bench.tell(ask, peer=late)[0].get_type() == "MISSION_ITEM_INT"
    assert bench.tell(ask, peer=old)[0].type == mavlink.MAV_MISSION_INVALID_SEQUENCE


def test_a_stretch_of_items_is_sent_on_request(bench: Any, make_mission: Any) -> None:
    bench.upload(make_mission(7))

    def ask(first: int, last: int) -> list[Any]:
        return bench.tell(mavlink.MAVLink_mission_request_partial_list_message(SYSID, 1, first, last, 0))

    assert [item.seq for item in ask(2, 4)] == [2, 3, 4]
    assert [item.seq for item in ask(5, -1)] == [5, 6]
    for first, last in [(2, 7), (4, 3), (-1, 3), (7, -1), (2, -2)]:
        assert bench.results(ask(first, last)) == [mavlink.MAV_MISSION_INVALID_SEQUENCE]


def test_a_stretch_of_the_plan_held_is_replaced_in_one_piece(bench: Any, make_mission: Any) -> None:
    old, new = make_mission(7), make_mission(12)
    bench.upload(old)
    assert bench.requested(bench.write_partial(2, 3)) == [2]
    assert bench.requested(bench.item(new[6:], 2)) == [3]
    assert bench.vehicle.mission == old
    (ack,) = bench.item(new[6:], 3)
    expected = (*old[:2], new[8], new[9], *old[4:])
    assert (ack.type, ack.opaque_id) == (ACCEPTED, opaque_id(MISSION, expected))
    assert bench.vehicle.mission.items == expected


def test_a_stretch_of_a_fence_makes_a_fence_again(bench: Any) -> None:
    bench.upload(A_FENCE, FENCE)
    last = len(A_FENCE) - 1
    wider = MissionItem(Command.NAV_FENCE_CIRCLE_EXCLUSION, param1=70.0)
    bench.write_partial(last, last, FENCE)
    assert bench.results(bench.raw_item(last, wider, FENCE)) == [ACCEPTED]
    assert bench.vehicle.items(FENCE) == (*A_FENCE[:-1], wider)
    bench.write_partial(2, 2, FENCE)
    assert bench.results(bench.raw_item(2, wider, FENCE)) == [ERROR]
    assert bench.vehicle.items(FENCE) == (*A_FENCE[:-1], wider)


@pytest.mark.parametrize(("first", "last"), [(2, 7), (4, 3), (-1, 3), (7, 7)])
def test_a_stretch_that_is_not_held_is_refused(bench: Any, make_mission: Any, first: int, last: int) -> None:
    bench.upload(make_mission(7))
    assert bench.results(bench.write_partial(first, last)) == [ERROR]
    assert "7 items are held" in bench.texts[-1].text


@pytest.mark.parametrize("clear", ["clear", "count 0"])
@pytest.mark.parametrize("plan", [MISSION, FENCE, RALLY])
def test_clearing_leaves_nothing_but_home(bench: Any, make_mission: Any, clear: str, plan: PlanType) -> None:
    held = {MISSION: make_mission(7), FENCE: A_FENCE, RALLY: SOME_RALLY}
    for one, items in held.items():
        bench.upload(items, one)
    (ack,) = bench.clear(plan) if clear == "clear" else bench.count(0, plan)
    assert (ack.type, ack.mission_type, ack.opaque_id) == (ACCEPTED, plan, 0)
    for one, items in held.items():
        expected = items if one != plan else make_mission(1) if one == MISSION else ()
        assert tuple(bench.vehicle.items(one)) == tuple(expected)
        assert (bench.server.plan_ids[one] == 0) == (one == plan)


def test_clearing_all_types_clears_all(bench: Any, make_mission: Any) -> None:
    for plan, items in [(MISSION, make_mission(7)), *OTHERS]:
        bench.upload(items, plan)
    (ack,) = bench.clear(ALL)
    assert (ack.type, ack.mission_type) == (ACCEPTED, ALL)
    assert bench.server.plan_ids == (0, 0, 0)
    assert bench.vehicle.mission == make_mission(1)
