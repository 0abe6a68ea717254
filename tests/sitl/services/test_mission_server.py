"""What is true of the vehicle's end of a mission transfer, fed by hand."""

from collections.abc import Callable
from typing import Any

import pytest
from pymavlink.dialects.v20 import ardupilotmega as mavlink

from missions.mission import Mission
from sitl.events import StatusText
from sitl.modes import Mode
from sitl.services.codec import Codec
from sitl.services.mission_items import decode_item, item_message
from sitl.services.mission_server import MAX_ITEMS, MissionServer
from sitl.services.opaque_id import opaque_id
from sitl.services.peer import Peer

PEER, OTHER_PEER = Peer("udp", "127.0.0.1", 14550), Peer("tcp", "127.0.0.1", 40000)
SYSID = 3


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

    def count(self, count: int, **kwargs: Any) -> list[Any]:
        return self.tell(mavlink.MAVLink_mission_count_message(SYSID, 1, count, 0), **kwargs)

    def item(self, mission: Mission, seq: int, **kwargs: Any) -> list[Any]:
        return self.tell(item_message(mission[seq], seq, SYSID, 1), **kwargs)

    def upload(self, mission: Mission, **kwargs: Any) -> list[Any]:
        self.count(len(mission), **kwargs)
        return [self.item(mission, seq, **kwargs) for seq in range(len(mission))][-1]

    def wait(self, seconds: float) -> list[Any]:
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
    assert all(answer.get_type() == "MISSION_REQUEST_INT" for answer in answers)
    return [answer.seq for answer in answers]


def test_an_upload_is_pulled_in_order_and_acknowledged_with_its_id(bench: Bench, make_mission: Any) -> None:
    mission = make_mission(4)
    assert requested(bench.count(4)) == [0]
    assert [requested(bench.item(mission, seq)) for seq in range(3)] == [[1], [2], [3]]
    (ack,) = bench.item(mission, 3)
    assert (ack.type, ack.opaque_id, ack.target_system) == (mavlink.MAV_MISSION_ACCEPTED, opaque_id(mission), 255)
    assert bench.vehicle.mission == mission


def test_item_0_is_replaced_by_home_whatever_it_says(bench: Bench, make_mission: Any) -> None:
    mission = make_mission(3)
    assert results(bench.upload(mission.with_home(mission[1]))) == [mavlink.MAV_MISSION_ACCEPTED]
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


def test_duplicates_are_ignored_and_items_ahead_bring_the_expected_request(bench: Bench, make_mission: Any) -> None:
    mission = make_mission(5)
    bench.count(5)
    bench.item(mission, 0)
    assert bench.item(mission, 0) == []
    assert requested(bench.item(mission, 3)) == [1]


def test_a_repeated_last_item_is_answered_as_before(bench: Bench, make_mission: Any) -> None:
    mission = make_mission(3)
    bench.upload(mission)
    assert results(bench.item(mission, 2)) == [mavlink.MAV_MISSION_ACCEPTED]
    assert bench.item(mission, 1) == []
    assert results(bench.item(mission, 2, peer=OTHER_PEER)) == [mavlink.MAV_MISSION_ERROR]


def test_a_refused_item_ends_the_upload_and_its_repeat_is_refused_again(bench: Bench, make_mission: Any) -> None:
    old = make_mission(6)
    bench.upload(old)
    bench.count(3)
    bench.item(old, 0)
    bad = mavlink.MAVLink_mission_item_int_message(SYSID, 1, 1, 0, 16, 0, 1, 0, 0, 0, 0, 95 * 10**7, 0, 0, 0)
    assert results(bench.tell(bad)) == [mavlink.MAV_MISSION_INVALID_PARAM5_X]
    assert results(bench.tell(bad)) == [mavlink.MAV_MISSION_INVALID_PARAM5_X]
    assert bench.vehicle.mission == old
    assert bench.texts[-1].text == "Mission item 1 refused: MAV_MISSION_INVALID_PARAM5_X"


def test_a_mission_that_cannot_be_flown_is_refused_with_the_reason(bench: Bench, make_mission: Any) -> None:
    bench.vehicle.refusal = "mission: no take-off; add a NAV_TAKEOFF as item 1"
    assert results(bench.upload(make_mission(3))) == [mavlink.MAV_MISSION_ERROR]
    assert bench.texts[-1].text == bench.vehicle.refusal


def test_a_missing_item_is_asked_for_again_each_second_and_given_up_after_eight(
    bench: Bench, make_mission: Any
) -> None:
    old, new = make_mission(4), make_mission(5)
    bench.upload(old)
    bench.count(5)
    bench.item(new, 0)
    assert bench.wait(0.9) == []
    assert [requested(bench.wait(1.0)) for _ in range(7)] == [[1]] * 7
    assert results(bench.wait(1.0)) == [mavlink.MAV_MISSION_OPERATION_CANCELLED]
    assert "timeout at item 1 of 5" in bench.texts[-1].text
    assert bench.vehicle.mission == old
    assert bench.wait(100.0) == []


def test_a_second_station_is_denied_and_the_same_one_restarts(bench: Bench, make_mission: Any) -> None:
    mission = make_mission(3)
    bench.count(3)
    bench.item(mission, 0)
    denied = [mavlink.MAV_MISSION_DENIED]
    assert results(bench.count(2, peer=OTHER_PEER)) == denied
    assert results(bench.count(2, sysid=254)) == denied
    assert results(bench.item(mission, 1, sysid=254)) == denied
    assert results(bench.tell(mavlink.MAVLink_mission_request_list_message(SYSID, 1, 0), peer=OTHER_PEER)) == denied
    assert results(bench.tell(mavlink.MAVLink_mission_clear_all_message(SYSID, 1, 0), peer=OTHER_PEER)) == denied
    assert requested(bench.count(3)) == [0]
    assert [bench.item(mission, seq) for seq in range(3)][-1][0].type == mavlink.MAV_MISSION_ACCEPTED


def test_a_station_can_cancel_its_own_upload_and_no_other_can(bench: Bench, make_mission: Any) -> None:
    cancel = mavlink.MAVLink_mission_ack_message(SYSID, 1, mavlink.MAV_MISSION_OPERATION_CANCELLED, 0)
    bench.count(3)
    bench.tell(cancel, peer=OTHER_PEER)
    assert requested(bench.wait(1.0)) == [0]
    bench.tell(cancel)
    assert bench.wait(1.0) == []
    assert bench.vehicle.mission == make_mission(1)


@pytest.mark.parametrize(
    "request_item", [mavlink.MAVLink_mission_request_message, mavlink.MAVLink_mission_request_int_message]
)
def test_a_download_gives_the_items_with_both_requests(
    bench: Bench, make_mission: Any, request_item: Callable[..., Any]
) -> None:
    mission = make_mission(7)
    bench.upload(mission)
    (count,) = bench.tell(mavlink.MAVLink_mission_request_list_message(SYSID, 1, 0))
    assert (count.count, count.opaque_id) == (7, opaque_id(mission))
    answers = [bench.tell(request_item(SYSID, 1, seq, 0)) for seq in range(7)]
    assert tuple(decode_item(item) for (item,) in answers) == mission.items
    assert results(bench.tell(request_item(SYSID, 1, 7, 0))) == [mavlink.MAV_MISSION_INVALID_SEQUENCE]


def test_a_download_stays_of_one_mission_while_another_is_uploaded(bench: Bench, make_mission: Any) -> None:
    old, new = make_mission(7), make_mission(5)
    bench.upload(old)
    bench.tell(mavlink.MAVLink_mission_request_list_message(SYSID, 1, 0), peer=OTHER_PEER)
    bench.upload(new.with_home(new[1]))
    (item,) = bench.tell(mavlink.MAVLink_mission_request_int_message(SYSID, 1, 6, 0), peer=OTHER_PEER)
    assert decode_item(item) == old[6]


@pytest.mark.parametrize("clear", ["clear", "clear all types", "count 0"])
def test_clearing_leaves_home(bench: Bench, make_mission: Any, clear: str) -> None:
    bench.upload(make_mission(7))
    if clear == "count 0":
        answers = bench.count(0)
    else:
        kind = mavlink.MAV_MISSION_TYPE_ALL if clear == "clear all types" else mavlink.MAV_MISSION_TYPE_MISSION
        answers = bench.tell(mavlink.MAVLink_mission_clear_all_message(SYSID, 1, kind))
        assert answers[0].mission_type == kind
    assert results(answers) == [mavlink.MAV_MISSION_ACCEPTED]
    assert bench.vehicle.mission == make_mission(1)
    assert bench.server.opaque_id == 0


def test_a_mission_being_flown_is_neither_replaced_nor_cleared(bench: Bench, make_mission: Any) -> None:
    mission = make_mission(4)
    bench.upload(mission)
    bench.vehicle.change(airborne=True, mode=Mode.AUTO)
    assert results(bench.count(3)) == [mavlink.MAV_MISSION_DENIED]
    assert "switch to LOITER first" in bench.texts[-1].text
    clear = mavlink.MAVLink_mission_clear_all_message(SYSID, 1, 0)
    assert results(bench.tell(clear)) == [mavlink.MAV_MISSION_ERROR]
    assert bench.vehicle.mission == mission
    bench.vehicle.change(mode=Mode.LOITER)
    assert requested(bench.count(3)) == [0]


def test_too_many_items_and_other_types_are_refused_by_cause(bench: Bench, make_mission: Any) -> None:
    assert results(bench.count(MAX_ITEMS + 1)) == [mavlink.MAV_MISSION_NO_SPACE]
    assert str(MAX_ITEMS) in bench.texts[-1].text
    for kind in (mavlink.MAV_MISSION_TYPE_FENCE, mavlink.MAV_MISSION_TYPE_RALLY, mavlink.MAV_MISSION_TYPE_ALL):
        (ack,) = bench.tell(mavlink.MAVLink_mission_count_message(SYSID, 1, 3, kind))
        assert (ack.type, ack.mission_type) == (mavlink.MAV_MISSION_UNSUPPORTED, kind)
        (ack,) = bench.tell(mavlink.MAVLink_mission_request_list_message(SYSID, 1, kind))
        assert (ack.type, ack.mission_type) == (mavlink.MAV_MISSION_UNSUPPORTED, kind)
    assert results(bench.item(make_mission(3), 1)) == [mavlink.MAV_MISSION_ERROR]


def test_what_is_addressed_to_another_vehicle_or_to_all_gets_silence(bench: Bench) -> None:
    for target in (SYSID + 1, 0):
        assert bench.tell(mavlink.MAVLink_mission_count_message(target, 1, 3, 0)) == []
        assert bench.tell(mavlink.MAVLink_mission_request_list_message(target, 1, 0)) == []
        assert bench.tell(mavlink.MAVLink_mission_clear_all_message(target, 1, 0)) == []


def test_an_upload_ends_with_the_peer_that_made_it(bench: Bench) -> None:
    bench.count(3)
    bench.server.forget(PEER)
    assert requested(bench.count(3, peer=OTHER_PEER)) == [0]
