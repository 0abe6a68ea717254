"""What a rehearsal puts on record; that its trajectories are an endpoint's, `test_demo.py` says."""

import pytest

from gcs.campaign.axes import with_values
from gcs.flight_record import Event
from gcs.rehearsal import RehearsalOptions, rehearse_plan
from gcs.report import report_on
from missions.scenario import Scenario
from planner.formation_plan import FormationPlan
from sitl.ticks import TICK_S


def test_whom_the_scenario_kills_is_lost_then_and_the_flight_is_still_whole(
    short: Scenario, short_plan: FormationPlan
) -> None:
    deadly = with_values(short, {"failures": [{"what": "kill", "at_s": 40.0, "vehicles": [2]}]})
    truths, record = rehearse_plan(deadly, short_plan, RehearsalOptions(1, 0.2))
    assert record.lost == {2: 40.0}
    assert record.events == (Event(40.0, 2, "lost: vehicle 2: killed, as scheduled"),)
    assert len(truths[2]) * TICK_S == 40.0
    report = report_on(deadly, short_plan, truths, record)
    assert report.metrics["trajectory_sha256"] is not None
    assert report.shortfalls == []
    assert [vehicle["completed"] for vehicle in report.metrics["vehicles"]] == [True, False, True]


def test_the_effective_delay_is_on_record_and_so_is_who_heard_whom(short: Scenario, short_plan: FormationPlan) -> None:
    _, record = rehearse_plan(short, short_plan, RehearsalOptions(7, 0.21))
    assert (record.seed, record.delay_s) == (7, pytest.approx(0.24))
    assert {(sender, receiver) for _, sender, receiver, used in record.edges if used} == {
        (p, q) for p in (1, 2, 3) for q in (1, 2, 3) if p != q
    }
