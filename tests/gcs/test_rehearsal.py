"""What a rehearsal puts on record; that its trajectories are an endpoint's, `test_demo.py` says."""

import numpy as np
import pytest

from gcs.campaign.axes import with_values
from gcs.flight_record import Event
from gcs.rehearsal import RehearsalOptions, rehearse_plan
from gcs.report import report_on
from missions.scenario import Scenario
from planner.formation_plan import FormationPlan
from planner.plan import plan
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


def test_wind_that_nobody_foresaw_costs_time_with_a_swarm_clock_and_not_the_formation(
    radars: Scenario,
) -> None:
    """Three metres a second from behind: the followers, planned at 20 m/s, can go no slower."""
    radars_plan = plan(radars)
    windy = with_values(radars, {"wind.steady_m_s": [3.0, 0.0]})
    formations = []
    for scenario in (windy, with_values(windy, {"formation.swarm_clock": True})):
        truths, record = rehearse_plan(scenario, radars_plan, RehearsalOptions(1, 0.2))
        report = report_on(scenario, radars_plan, truths, record)
        formations.append((report.metrics["formation"], report.series.error.rms_m))
    (apart, _), (together, error_m) = formations
    assert apart["rms_error_m"] > 100.0
    assert apart["slowed_s"] is apart["hurried_s"] is None
    assert np.nanmax(error_m) < 10.0
    assert together["rms_error_m"] < 4.0
    assert together["arrival_spread_s"] < 1.0
    assert together["hurried_s"] > 60.0
