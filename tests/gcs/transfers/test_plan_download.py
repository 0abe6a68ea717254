"""What a download makes of vehicles that are not Skein's."""

from typing import Any

import pytest
from pymavlink.dialects.v20 import ardupilotmega as mavlink

from gcs.transfers.errors import TransferError
from gcs.transfers.plan_download import WINDOW, PlanDownload
from missions.mission import MissionItem
from missions.plan_type import PlanType
from sitl.services.mission_items import item_message

LIST = "MISSION_REQUEST_LIST"
REQUEST = "MISSION_REQUEST_INT"


class Vehicle:
    """Answers what a download has sent, in its own way.

    Args:
        strict: whether it serves nothing but the item after the one before, or that once more.
        error: its MISSION_ACK for anything else; None for silence.
        forgets: whether it then serves nothing any more, until it is asked for the list again.
    """

    def __init__(
        self,
        scripted: Any,
        items: tuple[MissionItem, ...],
        strict: bool,
        error: int | None = None,
        forgets: bool = False,
    ) -> None:
        self.served: list[int] = []
        self._scripted = scripted
        self._items = items
        self._strict = strict
        self._error = error
        self._forgets = forgets
        self._over = False

    def answer(self, lost: tuple[int, ...] = ()) -> None:
        """Answer all that has been sent so far, but for the first request for each item that is lost."""
        asked, self._scripted.sent = self._scripted.sent, []
        for kind, seq in asked:
            if kind == LIST:
                self.served, self._over = [], False
                self._scripted.say(mavlink.MAVLink_mission_count_message(255, 190, len(self._items), 0))
            elif kind == REQUEST and seq not in lost:
                self._serve(seq)
            elif kind == REQUEST:
                lost = tuple(one for one in lost if one != seq)

    def _serve(self, seq: int) -> None:
        if self._over:
            return
        last = self.served[-1] if self.served else -1
        if not self._strict or seq in (last, last + 1):
            self.served.append(seq)
            self._scripted.say(item_message(self._items[seq], seq, 255, 190))
            return
        self._over = self._forgets
        if self._error is not None:
            self._scripted.say(mavlink.MAVLink_mission_ack_message(255, 190, self._error, 0))


@pytest.fixture
def download(scripted: Any) -> PlanDownload:
    transfer = PlanDownload(PlanType.MISSION, *scripted.link())
    scripted.start(transfer)
    return transfer


def requested(scripted: Any) -> list[int]:
    return [seq for kind, seq in scripted.sent if kind == REQUEST]


def test_a_window_of_items_is_asked_for_at_a_time_and_none_twice(
    scripted: Any, download: PlanDownload, make_mission: Any
) -> None:
    vehicle = Vehicle(scripted, make_mission(200).items, strict=False)
    widths = []
    while download.outcome is None:
        vehicle.answer()
        widths.append(len(requested(scripted)))
    assert widths[0] == max(widths) == WINDOW
    assert download.outcome == make_mission(200).items
    assert vehicle.served == list(range(200))  # none twice
    assert scripted.sent == [("MISSION_ACK", mavlink.MAV_MISSION_ACCEPTED)]


def test_a_request_overtaken_by_others_is_repeated_before_it_is_overdue(
    scripted: Any, download: PlanDownload, make_mission: Any
) -> None:
    vehicle = Vehicle(scripted, make_mission(50).items, strict=False)
    vehicle.answer()
    vehicle.answer(lost=(2,))
    assert 2 in requested(scripted)


@pytest.mark.parametrize("error", [mavlink.MAV_MISSION_INVALID_SEQUENCE, mavlink.MAV_MISSION_ERROR])
def test_who_insists_on_strict_order_is_asked_for_one_at_a_time_for_good(
    scripted: Any, download: PlanDownload, make_mission: Any, error: int
) -> None:
    vehicle = Vehicle(scripted, make_mission(40).items, strict=True, error=error)
    vehicle.answer()
    vehicle.answer(lost=(3,))
    for _ in range(100):
        scripted.wait(0.1)
        vehicle.answer()
    assert download.outcome == make_mission(40).items

    scripted.start(again := PlanDownload(PlanType.MISSION, *scripted.link()))
    del scripted.sent[:-1]
    vehicle.answer()
    for seq in range(40):
        assert requested(scripted) == [seq]
        vehicle.answer()
    assert again.outcome == make_mission(40).items


def test_who_insists_on_strict_order_without_a_word_is_found_out(
    scripted: Any, download: PlanDownload, make_mission: Any
) -> None:
    vehicle = Vehicle(scripted, make_mission(40).items, strict=True)
    vehicle.answer()
    vehicle.answer(lost=(3, 7))
    for _ in range(400):
        scripted.wait(0.1)
        vehicle.answer()
    assert download.outcome == make_mission(40).items


def test_who_ends_a_download_at_a_request_out_of_turn_without_a_word_is_asked_from_the_start(
    scripted: Any, download: PlanDownload, make_mission: Any
) -> None:
    vehicle = Vehicle(scripted, make_mission(40).items, strict=True, forgets=True)
    vehicle.answer()
    vehicle.answer(lost=(3, 7))
    for _ in range(1000):
        scripted.wait(0.1)
        scripted.say(mavlink.MAVLink_heartbeat_message(1, 12, 0, 0, 0, 3))
        vehicle.answer()
    assert download.outcome == make_mission(40).items


def test_a_plan_that_changes_in_the_middle_is_read_from_the_start(
    scripted: Any, download: PlanDownload, make_mission: Any
) -> None:
    Vehicle(scripted, make_mission(5).items, strict=False).answer()
    changed = make_mission(30)
    scripted.say(mavlink.MAVLink_mission_count_message(255, 190, len(changed), 0))
    vehicle = Vehicle(scripted, changed.items, strict=False)
    del scripted.sent[:-1]
    while download.outcome is None:
        vehicle.answer()
    assert download.outcome == changed.items


def test_a_vehicle_busy_with_another_station_is_asked_again_for_a_while(
    scripted: Any, download: PlanDownload, make_mission: Any
) -> None:
    denied = mavlink.MAVLink_mission_ack_message(255, 190, mavlink.MAV_MISSION_DENIED, 0)
    for _ in range(6):
        scripted.say(denied)
        scripted.wait(1.1)
    assert download.outcome is None
    for _ in range(10):
        scripted.say(denied)
        scripted.wait(1.1)
    assert "mission download refused at MISSION_REQUEST_LIST with MAV_MISSION_DENIED" in str(download.outcome)


def test_nothing_held_is_nothing(scripted: Any, download: PlanDownload) -> None:
    scripted.say(mavlink.MAVLink_mission_count_message(255, 190, 0, 0))
    assert download.outcome == ()


def test_a_dead_link_is_given_up_with_the_item_named(scripted: Any, download: PlanDownload, make_mission: Any) -> None:
    vehicle = Vehicle(scripted, make_mission(9).items, strict=False)
    vehicle.answer()
    vehicle.answer(lost=(2, 2, 2))
    scripted.wait(9.0)
    assert download.outcome is None
    scripted.wait(6.0)
    assert isinstance(download.outcome, TransferError)
    assert "vehicle 3: mission download stopped at item 2 of 9: no answer" in str(download.outcome)
    assert "last heard MISSION_ITEM_INT 8" in str(download.outcome)
