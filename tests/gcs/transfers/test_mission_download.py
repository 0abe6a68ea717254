"""What is true of a download, station's end against vehicle's end."""

import random
from typing import Any

from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from gcs.transfers.errors import TransferError
from gcs.transfers.mission_download import MissionDownload
from missions.mission import Mission


def download(link: Any) -> MissionDownload:
    return MissionDownload(link.vehicle.sysid, 1, link.send, link.now)


def test_items_held_are_items_got(make_vehicle: Any, make_mission: Any, lossy_link: Any) -> None:
    for count in (1, 2, 60):
        link = lossy_link(make_vehicle(3))
        link.vehicle.mission = make_mission(count)
        assert link.run(download(link)) == link.vehicle.mission


@settings(max_examples=60, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(losses=st.lists(st.booleans(), max_size=60))
def test_whatever_is_lost_it_gets_the_whole_mission_or_an_error(
    make_vehicle: Any, make_mission: Any, lossy_link: Any, losses: list[bool]
) -> None:
    pattern = iter(losses)
    link = lossy_link(make_vehicle(3), lambda: next(pattern, False))
    link.vehicle.mission = make_mission(9)
    outcome = link.run(download(link))
    assert outcome == link.vehicle.mission or isinstance(outcome, TransferError)


def test_a_tenth_of_every_kind_of_message_lost(make_vehicle: Any, make_mission: Any, lossy_link: Any) -> None:
    complete = 0
    for seed in range(20):
        rng = random.Random(seed)
        link = lossy_link(make_vehicle(3), lambda rng=rng: rng.random() < 0.1)
        link.vehicle.mission = make_mission(20)
        complete += isinstance(link.run(download(link)), Mission)
    assert complete == 20


def test_a_dead_link_is_given_up_with_the_vehicle_and_the_item_named(
    make_vehicle: Any, make_mission: Any, lossy_link: Any
) -> None:
    sent = iter(range(1, 1000))
    link = lossy_link(make_vehicle(3), lambda: next(sent) > 6)
    link.vehicle.mission = make_mission(9)
    error = link.run(download(link))
    assert str(error).startswith("vehicle 3: mission download stopped at item 2 of 9: no answer; check the link")
    assert "last heard MISSION_ITEM_INT 1" in str(error)


def test_retries_follow_the_measured_round_trip(make_vehicle: Any, make_mission: Any, lossy_link: Any) -> None:
    sent = iter(range(1, 1000))
    link = lossy_link(make_vehicle(3), lambda: next(sent) == 20, delay_s=0.005)
    link.vehicle.mission = make_mission(30)
    assert link.run(download(link)) == link.vehicle.mission
    resting_s = 10.0
    assert link.time_s < resting_s + 30 * 0.03 + 0.3
