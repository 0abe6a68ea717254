"""What is true of an upload, station's end against vehicle's end."""

import random
from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from pymavlink.dialects.v20 import ardupilotmega as mavlink

from gcs.transfers.compare import differences
from gcs.transfers.errors import TransferError
from gcs.transfers.mission_upload import MissionUpload, Uploaded
from sitl.modes import Mode
from sitl.services.codec import Codec

MISSION_KINDS = {"MISSION_COUNT", "MISSION_REQUEST_INT", "MISSION_ITEM_INT", "MISSION_ACK"}


def upload(link: Any, mission: Any) -> MissionUpload:
    return MissionUpload(mission, link.vehicle.sysid, 1, link.send, link.now)


def test_items_in_are_items_out(make_vehicle: Any, make_mission: Any, lossy_link: Any) -> None:
    link, mission = lossy_link(make_vehicle(3)), make_mission(60)
    assert link.run(upload(link, mission)) == Uploaded(confirmed=True)
    assert link.vehicle.mission == mission


@settings(max_examples=60, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(losses=st.lists(st.booleans(), max_size=60), count=st.integers(1, 12))
def test_whatever_is_lost_the_vehicle_holds_the_old_mission_or_the_new_one(
    make_vehicle: Any, make_mission: Any, lossy_link: Any, losses: list[bool], count: int
) -> None:
    vehicle, old, new = make_vehicle(3), make_mission(5).with_home(make_mission(1)[0]), make_mission(count)
    vehicle.mission = old
    pattern = iter(losses)
    link = lossy_link(vehicle, lambda: next(pattern, False))
    outcome = link.run(upload(link, new))
    assert vehicle.mission in (old, new)
    if outcome == Uploaded(confirmed=True):
        assert vehicle.mission == new
    elif isinstance(outcome, TransferError) and "stopped" in str(outcome):
        assert vehicle.mission == old


def test_a_quarter_of_every_kind_of_message_lost(make_vehicle: Any, make_mission: Any, lossy_link: Any) -> None:
    mission, kinds, outcomes = make_mission(20), set(), []
    for seed in range(20):
        rng = random.Random(seed)
        link = lossy_link(make_vehicle(3), lambda rng=rng: rng.random() < 0.25)
        outcomes.append(link.run(upload(link, mission)))
        kinds |= link.kinds_lost
        if isinstance(outcomes[-1], Uploaded):
            assert differences(mission, link.vehicle.mission) == [] or not outcomes[-1].confirmed
    assert kinds >= MISSION_KINDS
    assert sum(isinstance(outcome, Uploaded) for outcome in outcomes) >= 18


def test_the_last_ack_lost_brings_the_last_item_again(make_vehicle: Any, make_mission: Any, lossy_link: Any) -> None:
    messages_of_an_upload = 2 * 3 + 2
    sent = iter(range(1, 1000))
    link = lossy_link(make_vehicle(3), lambda: next(sent) == messages_of_an_upload)
    assert link.run(upload(link, make_mission(3))) == Uploaded(confirmed=True)
    assert link.kinds_lost == {"MISSION_ACK"}
    assert link.time_s < 11.0


def test_an_ack_that_never_comes_leaves_the_upload_unconfirmed(
    make_vehicle: Any, make_mission: Any, lossy_link: Any
) -> None:
    sent = iter(range(1, 1000))
    link, mission = lossy_link(make_vehicle(3), lambda: next(sent) >= 8), make_mission(3)
    assert link.run(upload(link, mission)) == Uploaded(confirmed=False)
    assert link.vehicle.mission == mission


def test_a_dead_link_is_given_up_with_the_vehicle_and_the_item_named(
    make_vehicle: Any, make_mission: Any, lossy_link: Any
) -> None:
    sent = iter(range(1, 1000))
    link = lossy_link(make_vehicle(3), lambda: next(sent) > 6)
    error = link.run(upload(link, make_mission(9)))
    assert isinstance(error, TransferError)
    assert str(error).startswith("vehicle 3: mission upload stopped at item 5 of 9: no further request;")
    assert "last heard MISSION_REQUEST_INT 3" in str(error)
    assert len(link.vehicle.mission) == 1

    silent = lossy_link(make_vehicle(4), lambda: True)
    error = silent.run(upload(silent, make_mission(9)))
    assert "vehicle 4: mission upload stopped at MISSION_COUNT 9" in str(error)
    assert "nothing heard" in str(error)


def test_a_refusal_ends_it_with_its_code(make_vehicle: Any, make_mission: Any, lossy_link: Any) -> None:
    link = lossy_link(make_vehicle(3))
    link.vehicle.change(airborne=True, mode=Mode.AUTO)
    assert "vehicle 3: mission refused at MISSION_COUNT 4 with MAV_MISSION_DENIED" in str(
        link.run(upload(link, make_mission(4)))
    )
    assert "switch to LOITER first" in link.texts[0]


class ArduPlane:
    """Pulls with the old MISSION_REQUEST, and sends INVALID_SEQUENCE when something comes twice."""

    def __init__(self) -> None:
        self.codec = Codec(1, 1)

    def message(self, message: Any) -> Any:
        return Codec(255, 190).feed(self.codec.pack(message))[0]


def test_it_answers_the_old_request_any_seq_and_goes_on_after_invalid_sequence(make_mission: Any) -> None:
    sent: list[Any] = []
    plane, mission = ArduPlane(), make_mission(4)
    transfer = MissionUpload(mission, 1, 1, sent.append, lambda: 0.0)
    transfer.start()
    for seq in (0, 1, 1, 3, 2):
        transfer.on_message(plane.message(mavlink.MAVLink_mission_request_message(255, 190, seq, 0)))
        assert sent[-1].seq == seq
    transfer.on_message(plane.message(mavlink.MAVLink_mission_ack_message(255, 190, 13, 0)))
    transfer.on_message(plane.message(mavlink.MAVLink_mission_ack_message(254, 190, 1, 0)))  # another station's
    transfer.on_message(plane.message(mavlink.MAVLink_mission_ack_message(255, 190, 0, 1)))  # a fence's
    assert transfer.outcome is None
    transfer.on_message(plane.message(mavlink.MAVLink_mission_ack_message(255, 190, 0, 0)))
    assert transfer.outcome == Uploaded(confirmed=True)


@pytest.mark.parametrize("count", [0, 1])
def test_the_smallest_missions(make_vehicle: Any, make_mission: Any, lossy_link: Any, count: int) -> None:
    link = lossy_link(make_vehicle(3))
    link.vehicle.mission = make_mission(5)
    mission = type(make_mission(1))(make_mission(1).items[:count])
    assert link.run(upload(link, mission)) == Uploaded(confirmed=True)
    assert link.vehicle.mission == make_mission(1)
