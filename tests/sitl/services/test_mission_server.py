"""What is true of the vehicle's end of plan transfers, fed by hand."""

from typing import Any

import pytest
from pymavlink.dialects.v20 import ardupilotmega as mavlink

from missions.commands import Command, Frame
from missions.errors import InputError
from missions.fence import Fence, FenceCircle, FencePolygon, fence_items, rally_items
from missions.mission import MissionItem
from missions.plan_type import PlanType
from sitl.modes import Mode
from sitl.services.mission_items import decode_item, item_message
from sitl.services.opaque_id import opaque_id
from sitl.services.peer import Peer
from sitl.services.plan_server import MAX_ITEMS

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


def test_an_upload_is_pulled_and_acknowledged_with_its_id(bench: Any, make_mission: Any) -> None:
    mission = make_mission(4)
    assert bench.requested(bench.count(4)) == [2, 0]
    assert [bench.requested(bench.item(mission, seq)) for seq in (2, 0, 1)] == [[1], [], [3]]
    (ack,) = bench.item(mission, 3)
    assert (ack.type, ack.opaque_id, ack.target_system) == (ACCEPTED, opaque_id(MISSION, mission), 255)
    assert bench.vehicle.mission == mission


@pytest.mark.parametrize(("plan", "items"), OTHERS)
def test_fences_and_rally_points_go_up_and_down_like_missions(
    bench: Any, make_mission: Any, plan: PlanType, items: Any
) -> None:
    bench.upload(make_mission(4))
    (ack,) = bench.upload(items, plan)
    assert (ack.type, ack.mission_type, ack.opaque_id) == (ACCEPTED, plan, opaque_id(plan, items))
    assert bench.vehicle.items(plan) == items
    assert bench.vehicle.mission == make_mission(4)
    (count,) = bench.list_plan(plan)
    assert (count.count, count.mission_type, count.opaque_id) == (len(items), plan, ack.opaque_id)
    answers = [
        bench.tell(mavlink.MAVLink_mission_request_int_message(SYSID, 1, seq, plan)) for seq in range(len(items))
    ]
    assert tuple(decode_item(item) for (item,) in answers) == items
    assert all(item.mission_type == plan for (item,) in answers)
    assert bench.server.plan_ids[plan] == ack.opaque_id


def test_item_0_is_replaced_by_home_whatever_it_says(bench: Any, make_mission: Any) -> None:
    mission = make_mission(3)
    assert bench.results(bench.upload(mission.with_home(mission[1]))) == [ACCEPTED]
    assert bench.vehicle.mission == mission


def test_the_old_mission_lives_until_the_last_item_is_in(bench: Any, make_mission: Any) -> None:
    old, new = make_mission(5), make_mission(3)
    bench.upload(old)
    bench.count(3)
    bench.item(new, 0)
    bench.item(new, 1)
    assert bench.vehicle.mission == old
    bench.item(new, 2)
    assert bench.vehicle.mission == new


def test_duplicates_are_ignored_and_unasked_items_bring_the_expected_request(bench: Any, make_mission: Any) -> None:
    mission = make_mission(9)
    bench.count(9)
    assert bench.item(mission, 7) == []
    bench.time_s = 0.2
    assert bench.requested(bench.item(mission, 7)) == [0]
    bench.item(mission, 0)
    assert bench.item(mission, 0) == []


def test_old_float_items_are_taken(bench: Any) -> None:
    bench.count(2)
    for seq in range(2):
        answers = bench.tell(
            mavlink.MAVLink_mission_item_message(SYSID, 1, seq, 3, 16, 0, 1, 0, 0, 0, 0, 46.5, 11.25, 300.0, 0)
        )
    assert bench.results(answers) == [ACCEPTED]
    assert bench.vehicle.mission[1] == MissionItem(16, 3, lat_e7=465_000_000, lon_e7=112_500_000, alt_m=300.0)


def test_a_repeated_last_item_is_answered_as_before(bench: Any, make_mission: Any) -> None:
    mission = make_mission(3)
    bench.upload(mission)
    assert bench.results(bench.item(mission, 2)) == [ACCEPTED]
    assert bench.item(mission, 1) == []
    assert bench.results(bench.item(mission, 2, peer=OTHER_PEER)) == [ERROR]
    assert bench.results(bench.item(make_mission(5), 4)) == [ERROR]
    assert bench.results(bench.raw_item(2, A_FENCE[2], FENCE)) == [ERROR]


def test_a_refused_item_ends_the_upload_and_its_repeat_is_refused_again(bench: Any, make_mission: Any) -> None:
    old = make_mission(6)
    bench.upload(old)
    bench.count(3)
    bench.item(old, 0)
    bad = MissionItem(Command.NAV_WAYPOINT, lat_e7=95 * 10**7)
    assert bench.results(bench.raw_item(1, bad)) == [mavlink.MAV_MISSION_INVALID_PARAM5_X]
    assert bench.results(bench.raw_item(1, bad)) == [mavlink.MAV_MISSION_INVALID_PARAM5_X]
    assert bench.vehicle.mission == old
    assert bench.texts[-1].text == "Mission item 1 refused: NAV_WAYPOINT (16) latitude 95"


def test_items_on_the_way_to_a_refusal_are_silent_once(bench: Any, make_mission: Any) -> None:
    mission = make_mission(9)
    bench.count(9)
    bench.item(mission, 0)
    assert bench.results(bench.raw_item(4, MissionItem(84))) == [mavlink.MAV_MISSION_UNSUPPORTED]
    assert bench.item(mission, 3) == []
    assert bench.results(bench.item(mission, 3)) == [mavlink.MAV_MISSION_UNSUPPORTED]


def test_a_mission_that_cannot_be_flown_is_refused_with_the_reason(bench: Any, make_mission: Any) -> None:
    bench.vehicle.refusal = "mission: no take-off; add a NAV_TAKEOFF as item 1"
    assert bench.results(bench.upload(make_mission(3))) == [ERROR]
    assert bench.texts[-1].text == bench.vehicle.refusal


@pytest.mark.parametrize("plan", [MISSION, FENCE, RALLY])
def test_a_plan_that_cannot_be_kept_is_not_accepted(
    bench: Any, make_mission: Any, monkeypatch: pytest.MonkeyPatch, plan: PlanType
) -> None:
    def full(*_: Any) -> None:
        raise InputError("mission: No space left on device; old one kept")

    items = {MISSION: make_mission(4), FENCE: A_FENCE, RALLY: SOME_RALLY}[plan]
    monkeypatch.setattr(bench.vehicle, "load", full)
    assert bench.results(bench.upload(items, plan)) == [ERROR]
    assert bench.results(bench.clear(plan)) == [ERROR]
    assert "No space left" in bench.texts[-1].text


@pytest.mark.parametrize(
    ("items", "reason"),
    [
        (A_FENCE[:4], "3 of 4 vertices"),
        ([MissionItem(Command.NAV_FENCE_CIRCLE_INCLUSION, param1=0.0)], "radius must be positive"),
        ([MissionItem(Command.NAV_FENCE_CIRCLE_EXCLUSION, param1=float("nan"))], "radius must be positive"),
        ([MissionItem(Command.NAV_FENCE_POLYGON_VERTEX_INCLUSION, param1=2.0)] * 2, "at least 3 vertices"),
        ([MissionItem(Command.NAV_FENCE_POLYGON_VERTEX_INCLUSION, param1=float("inf"))] * 3, "at least 3 vertices"),
    ],
)
def test_a_fence_that_is_none_is_refused_as_a_whole(bench: Any, items: Any, reason: str) -> None:
    bench.upload(A_FENCE, FENCE)
    assert bench.results(bench.upload(items, FENCE)) == [ERROR]
    assert reason in bench.texts[-1].text
    assert bench.vehicle.items(FENCE) == A_FENCE


def test_terrain_frames_are_refused_and_never_converted(bench: Any) -> None:
    for frame in (Frame.GLOBAL_TERRAIN_ALT, Frame.GLOBAL_TERRAIN_ALT_INT):
        bench.count(2)
        bench.raw_item(0, MissionItem(16))
        assert bench.results(bench.raw_item(1, MissionItem(16, frame))) == [mavlink.MAV_MISSION_UNSUPPORTED_FRAME]
        assert f"frame {Frame.GLOBAL_TERRAIN_ALT}" in bench.texts[-1].text
    assert len(bench.vehicle.mission) == 1


def test_a_missing_item_is_asked_for_again_and_given_up_after_eight_seconds_without_progress(
    bench: Any, make_mission: Any
) -> None:
    old, new = make_mission(4), make_mission(5)
    bench.upload(old)
    bench.count(5)
    bench.time_s += 0.05
    bench.item(new, 0)
    bench.item(new, 3)
    bench.item(new, 1)
    asked = []
    while bench.server.deadline_s < 8.05:
        asked += bench.requested(bench.wait(bench.server.deadline_s - bench.time_s))
    assert set(asked) == {2}
    assert 8 < len(asked) < 80
    assert bench.results(bench.wait(bench.server.deadline_s - bench.time_s)) == [
        mavlink.MAV_MISSION_OPERATION_CANCELLED
    ]
    assert bench.time_s == pytest.approx(8.05)
    assert "timeout at item 2 of 5" in bench.texts[-1].text
    assert bench.vehicle.mission == old
    assert bench.results(bench.item(new, 2)) == [mavlink.MAV_MISSION_OPERATION_CANCELLED]
    assert bench.wait(100.0) == []


def test_the_old_request_takes_turns_while_nothing_comes_and_stays_when_it_is_answered(
    bench: Any, make_mission: Any
) -> None:
    mission = make_mission(4)
    asked = [bench.count(4)] + [bench.wait(2.0) for _ in range(3)]
    assert all(bench.requested(messages) == [2, 0] for messages in asked)
    kinds = [[message.get_type() for message in messages] for messages in asked]
    assert kinds == [["MISSION_REQUEST_INT"] * 2, ["MISSION_REQUEST"] * 2] * 2
    (request,) = bench.item(mission, 2)
    bench.item(mission, 0)
    assert request.get_type() == "MISSION_REQUEST"
    bench.time_s += 0.2
    (request,) = bench.ack(mavlink.MAV_MISSION_UNSUPPORTED)
    assert (request.get_type(), request.seq) == ("MISSION_REQUEST_INT", 1)
    assert bench.ack(mavlink.MAV_MISSION_UNSUPPORTED) == []


def test_a_station_that_counts_again_without_answering_is_asked_the_other_way(bench: Any) -> None:
    assert [bench.count(4)[0].get_type() for _ in range(3)] == [
        "MISSION_REQUEST_INT",
        "MISSION_REQUEST",
        "MISSION_REQUEST_INT",
    ]


def test_a_second_station_is_denied_and_the_same_one_restarts(bench: Any, make_mission: Any) -> None:
    mission = make_mission(3)
    bench.upload(A_FENCE, FENCE)
    bench.count(3)
    bench.item(mission, 0)
    denied = [DENIED]
    assert bench.results(bench.count(2, peer=OTHER_PEER)) == denied
    assert bench.results(bench.count(0, peer=OTHER_PEER)) == denied
    assert bench.results(bench.count(2, FENCE, peer=OTHER_PEER)) == denied
    assert bench.results(bench.count(2, sysid=254)) == denied
    assert bench.results(bench.item(mission, 1, sysid=254)) == denied
    assert bench.results(bench.write_partial(0, 0, sysid=2)) == denied
    assert bench.results(bench.list_plan(peer=OTHER_PEER)) == denied
    for plan in (MISSION, FENCE, RALLY, ALL):
        assert bench.results(bench.clear(plan, peer=OTHER_PEER)) == denied
    assert bench.vehicle.items(FENCE) == A_FENCE
    assert bench.requested(bench.count(3)) == [0]
    assert [bench.item(mission, seq) for seq in range(3)][-1][0].type == ACCEPTED


def test_a_plan_of_another_type_is_downloaded_and_uploaded_at_the_same_time(bench: Any, make_mission: Any) -> None:
    mission = make_mission(4)
    bench.upload(A_FENCE, FENCE)
    bench.count(4)
    assert [bench.list_plan(FENCE, sysid=sysid)[0].count for sysid in (255, 254)] == [len(A_FENCE)] * 2
    assert bench.results(bench.upload(SOME_RALLY, RALLY)) == [ACCEPTED]
    assert [bench.requested(bench.item(mission, seq)) for seq in range(3)] == [[1], [2], [3]]
    assert bench.results(bench.item(mission, 3)) == [ACCEPTED]
    assert (bench.vehicle.mission, bench.vehicle.items(RALLY)) == (mission, SOME_RALLY)


def test_a_station_can_cancel_its_own_upload_and_no_other_can(bench: Any, make_mission: Any) -> None:
    cancelled = mavlink.MAV_MISSION_OPERATION_CANCELLED
    bench.count(3)
    bench.ack(cancelled, peer=OTHER_PEER)
    bench.ack(cancelled, RALLY)
    bench.ack(cancelled, 77)
    assert bench.requested(bench.wait(1.0)) == [0]
    bench.ack(cancelled)
    assert bench.wait(1.0) == []
    assert bench.vehicle.mission == make_mission(1)


def test_a_mission_being_flown_is_neither_replaced_nor_cleared(bench: Any, make_mission: Any) -> None:
    mission = make_mission(4)
    bench.upload(mission)
    bench.vehicle.change(airborne=True, mode=Mode.AUTO)
    for answers in (bench.count(3), bench.count(0), bench.write_partial(1, 1)):
        assert bench.results(answers) == [DENIED]
        assert "switch to LOITER first" in bench.texts[-1].text
    assert bench.results(bench.clear()) == [ERROR]
    assert bench.results(bench.clear(ALL)) == [ERROR]
    assert bench.vehicle.mission == mission
    for plan, items in OTHERS:
        assert bench.results(bench.upload(items, plan)) == [ACCEPTED]
        assert bench.results(bench.clear(plan)) == [ACCEPTED]
    bench.vehicle.change(mode=Mode.LOITER)
    assert bench.requested(bench.count(3)) == [0]


def test_a_mission_is_not_replaced_if_its_flight_has_begun_meanwhile(bench: Any, make_mission: Any) -> None:
    mission, new = make_mission(4), make_mission(3)
    bench.upload(mission)
    bench.count(3)
    bench.item(new, 0)
    bench.item(new, 1)
    bench.vehicle.change(airborne=True, mode=Mode.AUTO)
    assert bench.results(bench.item(new, 2)) == [DENIED]
    assert bench.vehicle.mission == mission
    assert "being flown" in bench.texts[-1].text


@pytest.mark.parametrize("plan", [MISSION, FENCE, RALLY])
def test_too_many_items_are_refused_with_the_limit(bench: Any, plan: PlanType) -> None:
    limit = MAX_ITEMS[plan]
    assert bench.results(bench.count(limit + 1, plan)) == [mavlink.MAV_MISSION_NO_SPACE]
    assert f"at most {limit}" in bench.texts[-1].text
    assert bench.requested(bench.count(limit, plan))[-1] == 0


@pytest.mark.parametrize("kind", [ALL, 3, 254])
def test_types_that_are_none_are_unsupported(bench: Any, make_mission: Any, kind: int) -> None:
    answers = bench.count(3, kind) + bench.list_plan(kind) + bench.raw_item(0, make_mission(1)[0], kind)
    answers += bench.tell(mavlink.MAVLink_mission_request_int_message(SYSID, 1, 0, kind))
    assert [(ack.type, ack.mission_type) for ack in answers] == [(mavlink.MAV_MISSION_UNSUPPORTED, kind)] * 4
    assert bench.ack(ACCEPTED, kind) == []


def test_an_item_without_an_upload_is_an_error(bench: Any, make_mission: Any) -> None:
    assert bench.results(bench.item(make_mission(3), 1)) == [ERROR]


def test_what_is_addressed_to_another_vehicle_gets_silence(bench: Any, make_mission: Any) -> None:
    for message in (
        mavlink.MAVLink_mission_count_message(SYSID + 1, 1, 3, 0),
        mavlink.MAVLink_mission_request_list_message(SYSID + 1, 1, 0),
        mavlink.MAVLink_mission_clear_all_message(SYSID + 1, 1, 0),
        item_message(make_mission(2)[1], 1, SYSID + 1, 1),
    ):
        assert bench.tell(message) == []


def test_what_is_addressed_to_all_is_answered_as_by_ardupilot(bench: Any) -> None:
    assert bench.tell(mavlink.MAVLink_mission_request_list_message(0, 0, 0))[0].count == 1
    assert bench.requested(bench.tell(mavlink.MAVLink_mission_count_message(0, 0, 3, 0))) == [0]


def test_an_upload_ends_with_the_peer_that_made_it(bench: Any) -> None:
    bench.count(3)
    bench.server.forget(bench.sent[-1][1])
    assert bench.requested(bench.count(3, peer=OTHER_PEER)) == [0]


def test_a_station_found_to_be_strict_is_not_tried_again(bench: Any, make_mission: Any) -> None:
    mission = make_mission(20)

    def asked_of_one_that_gives_only_the_next(peer: Peer) -> int:
        asked = bench.requested(bench.count(20, peer=peer))
        total = len(asked)
        for seq in range(20):
            assert seq in asked
            answers = bench.item(mission, seq, peer=peer)
            asked = bench.requested(answers) if seq < 19 else []
            total += len(asked)
        return total

    assert asked_of_one_that_gives_only_the_next(OTHER_PEER) == 20 + 9
    assert asked_of_one_that_gives_only_the_next(OTHER_PEER) == 20
    bench.server.forget(OTHER_PEER)
    assert asked_of_one_that_gives_only_the_next(OTHER_PEER) == 20 + 9
