"""What is true of the vehicle's end of plan transfers, fed by hand."""

from collections.abc import Callable
from typing import Any

import pytest
from pymavlink.dialects.v20 import ardupilotmega as mavlink

from missions.commands import Command, Frame
from missions.errors import InputError
from missions.fence import Fence, FenceCircle, FencePolygon, fence_items, rally_items
from missions.mission import MissionItem
from missions.plan_type import PlanType
from sitl.events import StatusText
from sitl.modes import Mode
from sitl.services.codec import Codec
from sitl.services.mission_items import decode_item, item_message
from sitl.services.mission_server import MissionServer
from sitl.services.opaque_id import opaque_id
from sitl.services.peer import Peer
from sitl.services.plan_server import MAX_ITEMS
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


class Bench:
    """A mission server, its vehicle, a clock, and all it says."""

    def __init__(self, vehicle: Any) -> None:
        self.vehicle = vehicle
        self.time_s = 0.0
        self.sent: list[tuple[Any, Peer]] = []
        self.texts: list[StatusText] = []
        self.server = MissionServer(
            vehicle, lambda message, peer: self.sent.append((message, peer)), self.texts.append, lambda: self.time_s
        )

    def tell(self, message: Any, peer: Peer = PEER, sysid: int = 255) -> list[Any]:
        """Feed one message over the wire; what the server says to that peer at once."""
        before = len(self.sent)
        for received in Codec(1, 1).feed(Codec(sysid, 190).pack(message)):
            self.server.on_message(received, peer)
        assert all(to == peer for _, to in self.sent[before:])
        return [answer for answer, _ in self.sent[before:]]

    def count(self, count: int, plan: int = PlanType.MISSION, **kwargs: Any) -> list[Any]:
        return self.tell(mavlink.MAVLink_mission_count_message(SYSID, 1, count, plan), **kwargs)

    def item(self, items: Any, seq: int, plan: PlanType = PlanType.MISSION, **kwargs: Any) -> list[Any]:
        return self.tell(item_message(items[seq], seq, SYSID, 1, plan), **kwargs)

    def raw_item(self, seq: int, item: MissionItem, plan: int = PlanType.MISSION, **kwargs: Any) -> list[Any]:
        fields = (SYSID, 1, seq, item.frame, item.command, 0, 1, *item.params, item.lat_e7, item.lon_e7, item.alt_m)
        return self.tell(mavlink.MAVLink_mission_item_int_message(*fields, plan), **kwargs)

    def ack(self, result: int, plan: int = PlanType.MISSION, **kwargs: Any) -> list[Any]:
        return self.tell(mavlink.MAVLink_mission_ack_message(SYSID, 1, result, plan), **kwargs)

    def list_plan(self, plan: int = PlanType.MISSION, **kwargs: Any) -> list[Any]:
        return self.tell(mavlink.MAVLink_mission_request_list_message(SYSID, 1, plan), **kwargs)

    def clear(self, plan: int = PlanType.MISSION, **kwargs: Any) -> list[Any]:
        return self.tell(mavlink.MAVLink_mission_clear_all_message(SYSID, 1, plan), **kwargs)

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


@pytest.fixture
def bench(make_vehicle: Any) -> Bench:
    return Bench(make_vehicle(SYSID))


def results(answers: list[Any]) -> list[int]:
    assert all(answer.get_type() == "MISSION_ACK" for answer in answers)
    return [answer.type for answer in answers]


def requested(answers: list[Any]) -> list[int]:
    assert all(answer.get_type() in ("MISSION_REQUEST_INT", "MISSION_REQUEST") for answer in answers)
    return [answer.seq for answer in answers]


def test_an_upload_is_pulled_and_acknowledged_with_its_id(bench: Bench, make_mission: Any) -> None:
    mission = make_mission(4)
    assert requested(bench.count(4)) == [0]
    assert [requested(bench.item(mission, seq)) for seq in range(3)] == [[1], [2], [3]]
    (ack,) = bench.item(mission, 3)
    assert (ack.type, ack.opaque_id, ack.target_system) == (ACCEPTED, opaque_id(MISSION, mission), 255)
    assert bench.vehicle.mission == mission


@pytest.mark.parametrize(("plan", "items"), OTHERS)
def test_fences_and_rally_points_go_up_and_down_like_missions(
    bench: Bench, make_mission: Any, plan: PlanType, items: Any
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


def test_item_0_is_replaced_by_home_whatever_it_says(bench: Bench, make_mission: Any) -> None:
    mission = make_mission(3)
    assert results(bench.upload(mission.with_home(mission[1]))) == [ACCEPTED]
    assert bench.vehicle.mission == mission


def test_the_old_mission_lives_until_the_last_item_is_in(bench: Bench, make_mission: Any) -> None:
    old, new = make_mission(5), make_mission(3)
    bench.upload(old)
    bench.count(3)
    bench.item(new, 0)
    bench.item(new, 1)
    assert bench.vehicle.mission == old
    bench.item(new, 2)
    assert bench.vehicle.mission == new


def test_duplicates_are_ignored_and_unasked_items_bring_the_expected_request(bench: Bench, make_mission: Any) -> None:
    mission = make_mission(9)
    bench.count(9)
    assert bench.item(mission, 7) == []
    bench.time_s = 0.2
    assert requested(bench.item(mission, 7)) == [0]
    bench.item(mission, 0)
    assert bench.item(mission, 0) == []


def test_old_float_items_are_taken(bench: Bench) -> None:
    bench.count(2)
    for seq in range(2):
        answers = bench.tell(
            mavlink.MAVLink_mission_item_message(SYSID, 1, seq, 3, 16, 0, 1, 0, 0, 0, 0, 46.5, 11.25, 300.0, 0)
        )
    assert results(answers) == [ACCEPTED]
    assert bench.vehicle.mission[1] == MissionItem(16, 3, lat_e7=465_000_000, lon_e7=112_500_000, alt_m=300.0)


def test_a_repeated_last_item_is_answered_as_before(bench: Bench, make_mission: Any) -> None:
    mission = make_mission(3)
    bench.upload(mission)
    assert results(bench.item(mission, 2)) == [ACCEPTED]
    assert bench.item(mission, 1) == []
    assert results(bench.item(mission, 2, peer=OTHER_PEER)) == [ERROR]
    assert results(bench.item(make_mission(5), 4)) == [ERROR]
    assert results(bench.raw_item(2, A_FENCE[2], FENCE)) == [ERROR]


def test_a_refused_item_ends_the_upload_and_its_repeat_is_refused_again(bench: Bench, make_mission: Any) -> None:
    old = make_mission(6)
    bench.upload(old)
    bench.count(3)
    bench.item(old, 0)
    bad = MissionItem(Command.NAV_WAYPOINT, lat_e7=95 * 10**7)
    assert results(bench.raw_item(1, bad)) == [mavlink.MAV_MISSION_INVALID_PARAM5_X]
    assert results(bench.raw_item(1, bad)) == [mavlink.MAV_MISSION_INVALID_PARAM5_X]
    assert bench.vehicle.mission == old
    assert bench.texts[-1].text == "Mission item 1 refused: NAV_WAYPOINT (16) latitude 95"


def test_items_on_the_way_to_a_refusal_are_silent_once(bench: Bench, make_mission: Any) -> None:
    mission = make_mission(9)
    bench.count(9)
    bench.item(mission, 0)
    assert results(bench.raw_item(4, MissionItem(84))) == [mavlink.MAV_MISSION_UNSUPPORTED]
    assert bench.item(mission, 3) == []
    assert results(bench.item(mission, 3)) == [mavlink.MAV_MISSION_UNSUPPORTED]


def test_a_mission_that_cannot_be_flown_is_refused_with_the_reason(bench: Bench, make_mission: Any) -> None:
    bench.vehicle.refusal = "mission: no take-off; add a NAV_TAKEOFF as item 1"
    assert results(bench.upload(make_mission(3))) == [ERROR]
    assert bench.texts[-1].text == bench.vehicle.refusal


@pytest.mark.parametrize("plan", [MISSION, FENCE, RALLY])
def test_a_plan_that_cannot_be_kept_is_not_accepted(
    bench: Bench, make_mission: Any, monkeypatch: pytest.MonkeyPatch, plan: PlanType
) -> None:
    def full(*_: Any) -> None:
        raise InputError("mission: No space left on device; old one kept")

    items = {MISSION: make_mission(4), FENCE: A_FENCE, RALLY: SOME_RALLY}[plan]
    monkeypatch.setattr(bench.vehicle, "load", full)
    assert results(bench.upload(items, plan)) == [ERROR]
    assert results(bench.clear(plan)) == [ERROR]
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
def test_a_fence_that_is_none_is_refused_as_a_whole(bench: Bench, items: Any, reason: str) -> None:
    bench.upload(A_FENCE, FENCE)
    assert results(bench.upload(items, FENCE)) == [ERROR]
    assert reason in bench.texts[-1].text
    assert bench.vehicle.items(FENCE) == A_FENCE


def test_terrain_frames_are_refused_and_never_converted(bench: Bench) -> None:
    for frame in (Frame.GLOBAL_RELATIVE_ALT + 7, 11):
        bench.count(2)
        bench.raw_item(0, MissionItem(16))
        assert results(bench.raw_item(1, MissionItem(16, frame))) == [mavlink.MAV_MISSION_UNSUPPORTED_FRAME]
        assert f"frame {frame}" in bench.texts[-1].text
    assert len(bench.vehicle.mission) == 1


def test_a_missing_item_is_asked_for_again_and_given_up_after_eight_seconds_without_progress(
    bench: Bench, make_mission: Any
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
        asked += requested(bench.wait(bench.server.deadline_s - bench.time_s))
    assert set(asked) == {2}
    assert 8 < len(asked) < 80
    assert results(bench.wait(bench.server.deadline_s - bench.time_s)) == [mavlink.MAV_MISSION_OPERATION_CANCELLED]
    assert bench.time_s == pytest.approx(8.05)
    assert "timeout at item 2 of 5" in bench.texts[-1].text
    assert bench.vehicle.mission == old
    assert results(bench.item(new, 2)) == [mavlink.MAV_MISSION_OPERATION_CANCELLED]
    assert bench.wait(100.0) == []


def test_the_old_request_takes_turns_while_nothing_comes_and_stays_when_it_is_answered(
    bench: Bench, make_mission: Any
) -> None:
    mission = make_mission(4)
    kinds = [bench.count(4)[0].get_type()]
    for _ in range(3):
        kinds += [message.get_type() for message in bench.wait(2.0)]
    assert kinds == ["MISSION_REQUEST_INT", "MISSION_REQUEST"] * 2
    (request,) = bench.item(mission, 0)
    assert request.get_type() == "MISSION_REQUEST"
    bench.time_s += 0.2
    (request,) = bench.ack(mavlink.MAV_MISSION_UNSUPPORTED)
    assert (request.get_type(), request.seq) == ("MISSION_REQUEST_INT", 1)
    assert bench.ack(mavlink.MAV_MISSION_UNSUPPORTED) == []


def test_a_station_that_counts_again_without_answering_is_asked_the_other_way(bench: Bench) -> None:
    assert [bench.count(4)[0].get_type() for _ in range(3)] == [
        "MISSION_REQUEST_INT",
        "MISSION_REQUEST",
        "MISSION_REQUEST_INT",
    ]


def test_a_second_station_is_denied_and_the_same_one_restarts(bench: Bench, make_mission: Any) -> None:
    mission = make_mission(3)
    bench.upload(A_FENCE, FENCE)
    bench.count(3)
    bench.item(mission, 0)
    denied = [DENIED]
    assert results(bench.count(2, peer=OTHER_PEER)) == denied
    assert results(bench.count(0, peer=OTHER_PEER)) == denied
    assert results(bench.count(2, FENCE, peer=OTHER_PEER)) == denied
    assert results(bench.count(2, sysid=254)) == denied
    assert results(bench.item(mission, 1, sysid=254)) == denied
    assert results(bench.tell(mavlink.MAVLink_mission_write_partial_list_message(SYSID, 1, 0, 0, 0), sysid=2)) == denied
    assert results(bench.list_plan(peer=OTHER_PEER)) == denied
    for plan in (MISSION, FENCE, RALLY, ALL):
        assert results(bench.clear(plan, peer=OTHER_PEER)) == denied
    assert bench.vehicle.items(FENCE) == A_FENCE
    assert requested(bench.count(3)) == [0]
    assert [bench.item(mission, seq) for seq in range(3)][-1][0].type == ACCEPTED


def test_a_plan_of_another_type_is_downloaded_and_uploaded_at_the_same_time(bench: Bench, make_mission: Any) -> None:
    mission = make_mission(4)
    bench.upload(A_FENCE, FENCE)
    bench.count(4)
    assert [bench.list_plan(FENCE, sysid=sysid)[0].count for sysid in (255, 254)] == [len(A_FENCE)] * 2
    assert results(bench.upload(SOME_RALLY, RALLY)) == [ACCEPTED]
    assert [requested(bench.item(mission, seq)) for seq in range(3)] == [[1], [2], [3]]
    assert results(bench.item(mission, 3)) == [ACCEPTED]
    assert (bench.vehicle.mission, bench.vehicle.items(RALLY)) == (mission, SOME_RALLY)


def test_a_station_can_cancel_its_own_upload_and_no_other_can(bench: Bench, make_mission: Any) -> None:
    cancelled = mavlink.MAV_MISSION_OPERATION_CANCELLED
    bench.count(3)
    bench.ack(cancelled, peer=OTHER_PEER)
    bench.ack(cancelled, RALLY)
    bench.ack(cancelled, 77)
    assert requested(bench.wait(1.0)) == [0]
    bench.ack(cancelled)
    assert bench.wait(1.0) == []
    assert bench.vehicle.mission == make_mission(1)


@pytest.mark.parametrize(
    "request_item", [mavlink.MAVLink_mission_request_message, mavlink.MAVLink_mission_request_int_message]
)
def test_a_download_gives_the_items_in_any_order_with_both_requests(
    bench: Bench, make_mission: Any, request_item: Callable[..., Any]
) -> None:
    mission = make_mission(7)
    bench.upload(mission)
    (count,) = bench.list_plan()
    assert (count.count, count.opaque_id) == (7, opaque_id(MISSION, mission))
    for seq in (6, 0, 3, 3, 5, 1, 2, 4):
        (item,) = bench.tell(request_item(SYSID, 1, seq, 0))
        assert (item.get_type(), item.seq, item.current) == ("MISSION_ITEM_INT", seq, int(seq == 1))
        assert decode_item(item) == mission[seq]
    assert results(bench.tell(request_item(SYSID, 1, 7, 0))) == [mavlink.MAV_MISSION_INVALID_SEQUENCE]
    assert bench.ack(ACCEPTED) == []


def test_a_download_stays_of_one_mission_while_another_is_uploaded(bench: Bench, make_mission: Any) -> None:
    old, new = make_mission(7), make_mission(5)
    bench.upload(old)
    bench.list_plan(peer=OTHER_PEER)
    bench.upload(new.with_home(new[1]))
    (item,) = bench.tell(mavlink.MAVLink_mission_request_int_message(SYSID, 1, 6, 0), peer=OTHER_PEER)
    assert decode_item(item) == old[6]


def test_downloads_that_nobody_ends_are_bounded(bench: Bench, make_mission: Any) -> None:
    bench.upload(make_mission(7))
    for compid in range(3 * MAX_STATIONS):
        bench.list_plan(peer=Peer("udp", "127.0.0.1", 20000 + compid))
    bench.upload(make_mission(3))
    old, late = (Peer("udp", "127.0.0.1", 20000 + number) for number in (0, 3 * MAX_STATIONS - 1))
    ask = mavlink.MAVLink_mission_request_int_message(SYSID, 1, 6, 0)
    assert bench.tell(ask, peer=late)[0].get_type() == "MISSION_ITEM_INT"
    assert bench.tell(ask, peer=old)[0].type == mavlink.MAV_MISSION_INVALID_SEQUENCE


def test_a_stretch_of_items_is_sent_on_request(bench: Bench, make_mission: Any) -> None:
    bench.upload(make_mission(7))

    def ask(first: int, last: int) -> list[Any]:
        return bench.tell(mavlink.MAVLink_mission_request_partial_list_message(SYSID, 1, first, last, 0))

    assert [item.seq for item in ask(2, 4)] == [2, 3, 4]
    assert [item.seq for item in ask(5, -1)] == [5, 6]
    for first, last in [(2, 7), (4, 3), (-1, 3), (7, -1), (2, -2)]:
        assert results(ask(first, last)) == [mavlink.MAV_MISSION_INVALID_SEQUENCE]


def write_partial(bench: Bench, first: int, last: int, plan: PlanType = MISSION) -> list[Any]:
    return bench.tell(mavlink.MAVLink_mission_write_partial_list_message(SYSID, 1, first, last, plan))


def test_a_stretch_of_the_plan_held_is_replaced_in_one_piece(bench: Bench, make_mission: Any) -> None:
    old, new = make_mission(7), make_mission(12)
    bench.upload(old)
    assert requested(write_partial(bench, 2, 3)) == [2]
    assert requested(bench.item(new[6:], 2)) == [3]
    assert bench.vehicle.mission == old
    (ack,) = bench.item(new[6:], 3)
    expected = (*old[:2], new[8], new[9], *old[4:])
    assert (ack.type, ack.opaque_id) == (ACCEPTED, opaque_id(MISSION, expected))
    assert bench.vehicle.mission.items == expected


def test_a_stretch_of_a_fence_makes_a_fence_again(bench: Bench) -> None:
    bench.upload(A_FENCE, FENCE)
    last = len(A_FENCE) - 1
    wider = MissionItem(Command.NAV_FENCE_CIRCLE_EXCLUSION, param1=70.0)
    write_partial(bench, last, last, FENCE)
    assert results(bench.raw_item(last, wider, FENCE)) == [ACCEPTED]
    assert bench.vehicle.items(FENCE) == (*A_FENCE[:-1], wider)
    write_partial(bench, 2, 2, FENCE)
    assert results(bench.raw_item(2, wider, FENCE)) == [ERROR]
    assert bench.vehicle.items(FENCE) == (*A_FENCE[:-1], wider)


@pytest.mark.parametrize(("first", "last"), [(2, 7), (4, 3), (-1, 3), (7, 7)])
def test_a_stretch_that_is_not_held_is_refused(bench: Bench, make_mission: Any, first: int, last: int) -> None:
    bench.upload(make_mission(7))
    assert results(write_partial(bench, first, last)) == [ERROR]
    assert "7 items are held" in bench.texts[-1].text


@pytest.mark.parametrize("clear", ["clear", "count 0"])
@pytest.mark.parametrize("plan", [MISSION, FENCE, RALLY])
def test_clearing_leaves_nothing_but_home(bench: Bench, make_mission: Any, clear: str, plan: PlanType) -> None:
    held = {MISSION: make_mission(7), FENCE: A_FENCE, RALLY: SOME_RALLY}
    for one, items in held.items():
        bench.upload(items, one)
    (ack,) = bench.clear(plan) if clear == "clear" else bench.count(0, plan)
    assert (ack.type, ack.mission_type, ack.opaque_id) == (ACCEPTED, plan, 0)
    for one, items in held.items():
        expected = items if one != plan else make_mission(1) if one == MISSION else ()
        assert tuple(bench.vehicle.items(one)) == tuple(expected)
        assert (bench.server.plan_ids[one] == 0) == (one == plan)


def test_clearing_all_types_clears_all(bench: Bench, make_mission: Any) -> None:
    for plan, items in [(MISSION, make_mission(7)), *OTHERS]:
        bench.upload(items, plan)
    (ack,) = bench.clear(ALL)
    assert (ack.type, ack.mission_type) == (ACCEPTED, ALL)
    assert bench.server.plan_ids == (0, 0, 0)
    assert bench.vehicle.mission == make_mission(1)


def test_a_mission_being_flown_is_neither_replaced_nor_cleared(bench: Bench, make_mission: Any) -> None:
    mission = make_mission(4)
    bench.upload(mission)
    bench.vehicle.change(airborne=True, mode=Mode.AUTO)
    for answers in (bench.count(3), bench.count(0), write_partial(bench, 1, 1)):
        assert results(answers) == [DENIED]
        assert "switch to LOITER first" in bench.texts[-1].text
    assert results(bench.clear()) == [ERROR]
    assert results(bench.clear(ALL)) == [ERROR]
    assert bench.vehicle.mission == mission
    for plan, items in OTHERS:
        assert results(bench.upload(items, plan)) == [ACCEPTED]
        assert results(bench.clear(plan)) == [ACCEPTED]
    bench.vehicle.change(mode=Mode.LOITER)
    assert requested(bench.count(3)) == [0]


def test_a_mission_is_not_replaced_if_its_flight_has_begun_meanwhile(bench: Bench, make_mission: Any) -> None:
    mission, new = make_mission(4), make_mission(3)
    bench.upload(mission)
    bench.count(3)
    bench.item(new, 0)
    bench.item(new, 1)
    bench.vehicle.change(airborne=True, mode=Mode.AUTO)
    assert results(bench.item(new, 2)) == [DENIED]
    assert bench.vehicle.mission == mission
    assert "being flown" in bench.texts[-1].text


@pytest.mark.parametrize("plan", [MISSION, FENCE, RALLY])
def test_too_many_items_are_refused_with_the_limit(bench: Bench, plan: PlanType) -> None:
    limit = MAX_ITEMS[plan]
    assert results(bench.count(limit + 1, plan)) == [mavlink.MAV_MISSION_NO_SPACE]
    assert f"at most {limit}" in bench.texts[-1].text
    assert requested(bench.count(limit, plan)) == [0]


@pytest.mark.parametrize("kind", [ALL, 3, 254])
def test_types_that_are_none_are_unsupported(bench: Bench, make_mission: Any, kind: int) -> None:
    answers = bench.count(3, kind) + bench.list_plan(kind) + bench.raw_item(0, make_mission(1)[0], kind)
    answers += bench.tell(mavlink.MAVLink_mission_request_int_message(SYSID, 1, 0, kind))
    assert [(ack.type, ack.mission_type) for ack in answers] == [(mavlink.MAV_MISSION_UNSUPPORTED, kind)] * 4
    assert bench.ack(ACCEPTED, kind) == []


def test_an_item_without_an_upload_is_an_error(bench: Bench, make_mission: Any) -> None:
    assert results(bench.item(make_mission(3), 1)) == [ERROR]


def test_what_is_addressed_to_another_vehicle_gets_silence(bench: Bench, make_mission: Any) -> None:
    for message in (
        mavlink.MAVLink_mission_count_message(SYSID + 1, 1, 3, 0),
        mavlink.MAVLink_mission_request_list_message(SYSID + 1, 1, 0),
        mavlink.MAVLink_mission_clear_all_message(SYSID + 1, 1, 0),
        item_message(make_mission(2)[1], 1, SYSID + 1, 1),
    ):
        assert bench.tell(message) == []


def test_what_is_addressed_to_all_is_answered_as_by_ardupilot(bench: Bench) -> None:
    assert bench.tell(mavlink.MAVLink_mission_request_list_message(0, 0, 0))[0].count == 1
    assert requested(bench.tell(mavlink.MAVLink_mission_count_message(0, 0, 3, 0))) == [0]


def test_an_upload_ends_with_the_peer_that_made_it(bench: Bench) -> None:
    bench.count(3)
    bench.server.forget(bench.sent[-1][1])
    assert requested(bench.count(3, peer=OTHER_PEER)) == [0]


def test_a_station_found_to_be_strict_is_not_tried_again(bench: Bench, make_mission: Any) -> None:
    mission = make_mission(20)

    def asked_of_one_that_gives_only_the_next(peer: Peer) -> int:
        asked = requested(bench.count(20, peer=peer))
        total = 1
        for seq in range(20):
            assert seq in asked
            answers = bench.item(mission, seq, peer=peer)
            asked = requested(answers) if seq < 19 else []
            total += len(asked)
        return total

    assert asked_of_one_that_gives_only_the_next(OTHER_PEER) == 20 + 9
    assert asked_of_one_that_gives_only_the_next(OTHER_PEER) == 20
    bench.server.forget(OTHER_PEER)
    assert asked_of_one_that_gives_only_the_next(OTHER_PEER) == 20 + 9
