"""Who has not heard how an upload ended is asked again, so that it can be told again; nobody else is bothered."""

from typing import Any

import pytest
from pymavlink.dialects.v20 import ardupilotmega as mavlink

from missions.fence import rally_items
from missions.mission import MissionItem
from missions.plan_type import PlanType
from sitl.services.ended_upload import ASKS_AGAIN_S
from sitl.services.peer import Peer

OTHER_PEER = Peer("tcp", "127.0.0.1", 40000)
ACCEPTED, UNSUPPORTED = mavlink.MAV_MISSION_ACCEPTED, mavlink.MAV_MISSION_UNSUPPORTED
RALLY = rally_items([(1, 2, 100.0), (3, 4, 120.0)])


def asked_again(bench: Any) -> list[tuple[float, int, int]]:
    """When what is asked for in a long silence: seconds from now, item, type of plan."""
    began_s, asked = bench.time_s, []
    while bench.server.deadline_s < began_s + 100.0:
        for request in bench.wait(bench.server.deadline_s - bench.time_s):
            assert request.get_type() == "MISSION_REQUEST_INT"
            asked.append((pytest.approx(bench.time_s - began_s), request.seq, request.mission_type))
    return asked


def test_a_silent_station_is_asked_for_the_last_item_and_told_again_each_time(
    plan_bench: Any, make_mission: Any
) -> None:
    mission = make_mission(4)
    plan_bench.upload(mission)
    for _ in ASKS_AGAIN_S:
        (request,) = plan_bench.wait(plan_bench.server.deadline_s - plan_bench.time_s)
        assert plan_bench.results(plan_bench.item(mission, request.seq)) == [ACCEPTED]
    assert plan_bench.wait(100.0) == []
    assert plan_bench.vehicle.mission == mission


def test_it_is_asked_within_the_patience_of_other_stations(plan_bench: Any) -> None:
    plan_bench.upload(RALLY, PlanType.RALLY)
    assert asked_again(plan_bench) == [(at_s, 1, PlanType.RALLY) for at_s in ASKS_AGAIN_S]
    assert 0.5 < ASKS_AGAIN_S[0] < 1.5, "after MAVSDK's second MISSION_COUNT of what comes next, before QGC gives up"
    assert len(ASKS_AGAIN_S) < 5, "MAVSDK gives up when asked for an item so often"


def test_an_item_that_was_refused_is_asked_for_so_that_the_reason_arrives(plan_bench: Any, make_mission: Any) -> None:
    plan_bench.count(3)
    plan_bench.item(make_mission(3), 0)
    assert plan_bench.results(plan_bench.raw_item(1, MissionItem(84))) == [UNSUPPORTED]
    assert [seq for _, seq, _ in asked_again(plan_bench)] == [1] * len(ASKS_AGAIN_S)
    assert plan_bench.results(plan_bench.raw_item(1, MissionItem(84))) == [UNSUPPORTED]


@pytest.mark.parametrize(
    "go_on",
    [
        lambda bench: bench.list_plan(),
        lambda bench: bench.list_plan(PlanType.FENCE),
        lambda bench: bench.upload(RALLY[:1], PlanType.RALLY),
        lambda bench: bench.clear(PlanType.FENCE),
        lambda bench: bench.ack(ACCEPTED),
        lambda bench: bench.server.forget(Peer("udp", "127.0.0.1", 14550)),
    ],
)
def test_a_station_that_has_gone_on_is_left_alone(plan_bench: Any, make_mission: Any, go_on: Any) -> None:
    plan_bench.upload(make_mission(4))
    go_on(plan_bench)
    assert asked_again(plan_bench) == []


def test_what_another_station_does_says_nothing_of_this_one(plan_bench: Any, make_mission: Any) -> None:
    plan_bench.upload(make_mission(4))
    plan_bench.list_plan(peer=OTHER_PEER)
    assert len(asked_again(plan_bench)) == len(ASKS_AGAIN_S)


def test_an_upload_of_one_item_is_not_asked_for_as_it_could_be_another_ones(plan_bench: Any) -> None:
    plan_bench.upload(RALLY[:1], PlanType.RALLY)
    assert asked_again(plan_bench) == []


def test_a_station_that_was_given_up_is_not_asked_any_more(plan_bench: Any, make_mission: Any) -> None:
    plan_bench.count(4)
    plan_bench.item(make_mission(4), 0)
    assert plan_bench.results(plan_bench.wait(9.0)) == [mavlink.MAV_MISSION_OPERATION_CANCELLED]
    assert asked_again(plan_bench) == []
