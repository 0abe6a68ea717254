"""What an upload makes of vehicles that are not Skein's."""

from typing import Any

import pytest
from pymavlink.dialects.v20 import ardupilotmega as mavlink

from gcs.transfers.errors import TransferError
from gcs.transfers.plan_upload import PlanUpload, Uploaded
from missions.plan_type import PlanType

COUNT = ("MISSION_COUNT", None)


def ack(result: int, target: int = 255, plan_type: PlanType = PlanType.MISSION) -> Any:
    return mavlink.MAVLink_mission_ack_message(target, 190, result, plan_type)


def request(seq: int) -> Any:
    return mavlink.MAVLink_mission_request_message(255, 190, seq, 0)


def item(seq: int) -> tuple[str, int]:
    return ("MISSION_ITEM_INT", seq)


@pytest.fixture
def upload(scripted: Any, make_mission: Any) -> PlanUpload:
    transfer = PlanUpload(PlanType.MISSION, make_mission(4).items, *scripted.link())
    scripted.start(transfer)
    return transfer


def test_it_answers_either_request_any_seq_and_goes_on_after_invalid_sequence(
    scripted: Any, upload: PlanUpload
) -> None:
    for seq in (0, 1, 1, 3):
        scripted.say(request(seq))
        assert scripted.sent[-1] == item(seq)
    scripted.say(mavlink.MAVLink_mission_request_int_message(255, 190, 2, 0))
    assert scripted.sent[-1] == item(2)
    for nothing_of_it in (
        ack(mavlink.MAV_MISSION_INVALID_SEQUENCE),
        ack(mavlink.MAV_MISSION_ERROR, target=254),
        ack(mavlink.MAV_MISSION_ACCEPTED, plan_type=PlanType.FENCE),
        request(4),
    ):
        scripted.say(nothing_of_it)
    assert upload.outcome is None
    scripted.say(ack(mavlink.MAV_MISSION_ACCEPTED))
    assert upload.outcome == Uploaded(confirmed=True)


def test_an_ack_of_an_earlier_upload_is_not_taken_for_this_ones(scripted: Any, upload: PlanUpload) -> None:
    scripted.say(ack(mavlink.MAV_MISSION_ACCEPTED))
    scripted.say(request(0))
    scripted.say(ack(mavlink.MAV_MISSION_ACCEPTED))
    assert upload.outcome is None


def test_a_refusal_is_believed_the_second_time(scripted: Any, upload: PlanUpload) -> None:
    scripted.say(request(0))
    scripted.say(ack(mavlink.MAV_MISSION_DENIED))
    scripted.say(ack(mavlink.MAV_MISSION_DENIED))  # said twice for the first start: late
    assert upload.outcome is None
    assert scripted.sent == [COUNT, item(0), COUNT]
    scripted.wait(1.0)
    scripted.say(ack(mavlink.MAV_MISSION_DENIED))
    assert "MAV_MISSION_DENIED (another station may have a transfer running" in str(upload.outcome)


def test_a_vehicle_that_is_not_ready_yet_is_waited_for(scripted: Any, upload: PlanUpload) -> None:
    scripted.say(mavlink.MAVLink_statustext_message(4, b"Only 0 items are supported"))
    for _ in range(10):
        scripted.say(ack(mavlink.MAV_MISSION_NO_SPACE))
        scripted.wait(1.1)
    assert upload.outcome is None
    scripted.say(request(0))
    assert scripted.sent[-1] == item(0)


def test_a_vehicle_that_never_gets_ready_is_given_up(scripted: Any, upload: PlanUpload) -> None:
    scripted.say(mavlink.MAVLink_statustext_message(4, b"Only 0 items are supported"))
    for _ in range(60):
        scripted.say(ack(mavlink.MAV_MISSION_NO_SPACE))
        scripted.wait(1.1)
    assert "at MISSION_COUNT 4" in str(upload.outcome)
    assert "it is not ready to take any items" in str(upload.outcome)


def test_too_many_items_are_an_error(scripted: Any, upload: PlanUpload) -> None:
    for _ in range(2):
        scripted.say(mavlink.MAVLink_statustext_message(4, b"Only 3 items are supported"))
        scripted.say(ack(mavlink.MAV_MISSION_NO_SPACE))
        scripted.wait(1.0)
    assert "MAV_MISSION_NO_SPACE (it takes fewer items)" in str(upload.outcome)


def test_when_the_vehicle_gives_up_the_upload_begins_again_but_not_for_ever(scripted: Any, upload: PlanUpload) -> None:
    for start in range(1, 6):
        assert upload.outcome is None
        assert scripted.sent.count(COUNT) == start
        scripted.say(request(0))
        scripted.say(ack(mavlink.MAV_MISSION_OPERATION_CANCELLED))
    assert "MAV_MISSION_OPERATION_CANCELLED (it gave up waiting, each time" in str(upload.outcome)


def test_in_silence_the_last_item_asked_for_is_sent_again_and_the_next(scripted: Any, upload: PlanUpload) -> None:
    scripted.say(request(0))
    scripted.say(request(1))
    del scripted.sent[:]
    scripted.wait(2.0)
    assert scripted.sent[:2] == [item(1), item(2)]
    scripted.say(request(0))  # it has gone back to that
    del scripted.sent[:]
    scripted.wait(2.0)
    assert scripted.sent[:2] == [item(0), item(1)]


def test_arduplanes_word_for_a_last_item_that_came_again_sends_to_read_back(scripted: Any, upload: PlanUpload) -> None:
    for seq in range(4):
        scripted.say(request(seq))
    scripted.wait(1.0)
    scripted.say(ack(mavlink.MAV_MISSION_ERROR))
    assert upload.outcome == Uploaded(confirmed=False)


def test_a_cancelled_upload_is_told_to_the_vehicle(scripted: Any, upload: PlanUpload) -> None:
    scripted.say(request(0))
    upload.cancel()
    assert scripted.sent[-1] == ("MISSION_ACK", mavlink.MAV_MISSION_OPERATION_CANCELLED)


def test_a_vehicle_that_is_heard_but_does_not_go_on_is_given_up_later(scripted: Any, upload: PlanUpload) -> None:
    scripted.say(request(0))
    for _ in range(25):
        scripted.say(request(0))
        scripted.wait(1.0)
    assert upload.outcome is None
    for _ in range(10):
        scripted.say(request(0))
        scripted.wait(1.0)
    assert isinstance(upload.outcome, TransferError)
    assert "vehicle 3: mission upload stopped at item 0 of 4" in str(upload.outcome)
    assert scripted.sent[-1] == ("MISSION_ACK", mavlink.MAV_MISSION_OPERATION_CANCELLED)


@pytest.mark.parametrize("count", [0, 1])
def test_the_smallest_missions(lossy_link: Any, make_vehicle: Any, make_mission: Any, count: int) -> None:
    link = lossy_link(make_vehicle(3))
    link.vehicle.mission = make_mission(5)
    items = make_mission(1).items[:count]
    assert link.run(PlanUpload(PlanType.MISSION, items, *link.link())) == Uploaded(confirmed=True)
    assert link.vehicle.mission == make_mission(1)
