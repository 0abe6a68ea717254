"""A flight that is over, gone about in."""

import math
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from gcs.campaign.axes import with_values
from gcs.console.recording import Recording
from gcs.flight_record import DISTURBANCE, Event
from gcs.report_page import FlownRun, read_flown_run
from gcs.truth import CHI, GAMMA, H, V, X
from missions.scenario import Scenario
from planner.formation_plan import FormationPlan
from sitl.ticks import TICK_S

KILLED_S = 40.0


@pytest.fixture
def recording(flown: FlownRun) -> Recording:
    recording = Recording(flown)
    recording.playing = False
    return recording


@pytest.fixture(scope="module")
def bereaved(
    keep_run: Callable[..., Path], short: Scenario, short_scenario: Path, short_plan: FormationPlan
) -> Recording:
    """One of three was killed."""
    text = short_scenario.read_text() + f'\n[[failures]]\nwhat = "kill"\nat_s = {KILLED_S}\nvehicles = [2]\n'
    deadly = with_values(short, {"failures": [{"what": "kill", "at_s": KILLED_S, "vehicles": [2]}]})
    recording = Recording(read_flown_run(keep_run(deadly, text, short_plan)))
    recording.playing = False
    return recording


def test_at_a_tick_everyone_is_where_the_truth_says(recording: Recording, flown: FlownRun) -> None:
    for tick in (0, 1, 500, 1500):
        recording.t_s = tick * TICK_S
        moment = recording.advance(0.0)
        assert moment.sysids == (1, 2, 3)
        truth = np.stack([flown.truths[sysid][tick] for sysid in moment.sysids])
        assert moment.position_m == pytest.approx(truth[:, X : H + 1])
        assert moment.attitude_rad[:, 1:] == pytest.approx(truth[:, [GAMMA, CHI]])


@given(share=st.floats(0.0, 1.0))
def test_between_ticks_it_is_on_the_straight_line(flown: FlownRun, share: float) -> None:
    recording = Recording(flown)
    recording.playing = False
    recording.t_s = (1000.0 + share) * TICK_S
    before, after = flown.truths[2][1000, X : H + 1], flown.truths[2][1001, X : H + 1]
    assert recording.advance(0.0).position_m[1] == pytest.approx((1.0 - share) * before + share * after)


def test_in_a_turn_to_the_left_the_right_wing_is_up(recording: Recording, flown: FlownRun) -> None:
    chi = np.unwrap(flown.truths[1][:, CHI])
    steepest = int(np.argmax(np.gradient(chi)))
    recording.t_s = steepest * TICK_S
    roll = recording.advance(0.0).attitude_rad[0, 0]
    rate = (chi[steepest + 1] - chi[steepest - 1]) / (2.0 * TICK_S)
    assert rate > 0.05
    assert roll == pytest.approx(-math.atan(flown.truths[1][steepest, V] * rate / 9.80665), rel=1e-3)


def test_it_plays_at_its_speed_to_the_end_and_then_stands(flown: FlownRun) -> None:
    recording = Recording(flown)
    recording.speed = 5.0
    assert recording.advance(2.0).t_s == 10.0
    assert recording.state() == "recorded, 5 x"
    recording.playing = False
    assert recording.advance(2.0).t_s == 10.0
    recording.playing = True
    assert recording.advance(1e9).t_s == recording.duration_s == (len(flown.truths[1]) - 1) * TICK_S
    assert not recording.playing
    assert recording.state() == "recorded, paused"
    assert np.isfinite(recording.advance(1.0).position_m).all()


def test_rows_say_what_each_does_at_that_moment(recording: Recording, flown: FlownRun) -> None:
    recording.t_s = 10.0
    recording.advance(0.0)
    rows = recording.rows()
    assert [(row.sysid, row.name, row.mode) for row in rows] == [(i, recording.names[i], "AUTO") for i in (1, 2, 3)]
    tick = round(10.0 / TICK_S)
    assert rows[0].speed_m_s == flown.truths[1][tick, V]
    assert rows[0].altitude_m == flown.truths[1][tick, H] + flown.scenario.frame.alt_m
    assert rows[0].link == "0.20 s"
    assert rows[0].error_m == pytest.approx(0.0, abs=5.0)
    first, last = rows[0].item or (0, 0)
    recording.t_s = recording.duration_s
    recording.advance(0.0)
    rows = recording.rows()
    assert {row.mode for row in rows} == {"arrived"}
    assert rows[0].item == (last, last)
    assert first < (last or 0)


def test_a_mode_that_was_logged_stands_for_the_plan_and_then_there_is_no_error_of_it(flown: FlownRun) -> None:
    recording = Recording(flown, {1: [(0.0, "AUTO"), (20.0, "LOITER")]})
    recording.t_s, recording.playing = 10.0, False
    first, *_ = recording.rows()
    assert (first.mode, first.error_m is None, first.link) == ("AUTO", False, "0.20 s")
    recording.t_s = 30.0
    first, second, _ = recording.rows()
    assert (first.mode, first.error_m, first.link) == ("LOITER", None, "")
    assert second.mode == "AUTO"


def test_nobody_knows_how_old_corrections_were_once_they_were_disturbed(flown: FlownRun) -> None:
    disturbed = Event(20.0, None, f"{DISTURBANCE}1 s later, 0 % lost, from tick 500 on")
    recording = Recording(replace(flown, metrics=replace(flown.metrics, events=(disturbed,))))
    recording.playing = False
    for t_s, age_s, text in ((10.0, 0.2, "0.20 s"), (30.0, None, "")):
        recording.t_s = t_s
        assert {link.age_s for link in recording.links()} == {age_s}
        assert {row.link for row in recording.rows()} == {text}
    delays = recording.course().delay_s[recording.course().t_s >= 20.0]
    assert np.isnan(delays).all()


def test_a_trail_ends_where_it_is_and_begins_so_long_before(recording: Recording, flown: FlownRun) -> None:
    recording.t_s = 50.0
    moment = recording.advance(0.0)
    trails = recording.trails(20.0, 11)
    assert trails.shape == (3, 11, 3)
    assert trails[:, -1] == pytest.approx(moment.position_m)
    assert trails[0, 0] == pytest.approx(flown.truths[1][round(30.0 / TICK_S), X : H + 1])
    assert trails[2, 5] == pytest.approx(flown.truths[3][round(40.0 / TICK_S), X : H + 1])


def test_links_are_the_graph_as_it_was_used_with_the_delay(recording: Recording) -> None:
    recording.t_s = 10.0
    links = recording.links()
    assert [link.pair for link in links] == [(1, 2), (1, 3), (2, 3)]
    assert [link.age_s for link in links] == pytest.approx([0.2] * 3)


def test_curves_are_of_the_whole_flight_and_say_how_much_of_it_has_been(recording: Recording, flown: FlownRun) -> None:
    recording.t_s = 0.0
    assert recording.course().now == 1
    recording.t_s = recording.duration_s
    course = recording.course()
    assert course.now == len(course.t_s)
    tick = len(course.t_s) // 2
    there = round(course.t_s[tick] / TICK_S)
    assert course.error_m[tick] == flown.series.error.rms_m[there]
    assert course.separation_m[tick] == flown.series.separation_m[there]


def test_who_was_killed_is_lost_from_then_on_and_nowhere(bereaved: Recording) -> None:
    bereaved.t_s = KILLED_S - 1.0
    before = bereaved.advance(0.0)
    assert np.isfinite(before.position_m).all()
    assert [row.mode for row in bereaved.rows()] == ["AUTO"] * 3
    assert (1, 2) in [link.pair for link in bereaved.links()]
    bereaved.t_s = KILLED_S + 20.0
    after = bereaved.advance(0.0)
    assert np.isnan(after.position_m[1]).all()
    assert np.isfinite(after.position_m[[0, 2]]).all()
    assert [(row.mode, row.well) for row in bereaved.rows()] == [("AUTO", True), ("lost", False), ("AUTO", True)]
    assert [link.pair for link in bereaved.links()] == [(1, 3)]
