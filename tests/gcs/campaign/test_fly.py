"""Flights of a campaign in this process: what their rows say, and what is flown when."""

from collections.abc import Iterator
from concurrent.futures import Executor, Future
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path

import pytest

from gcs.campaign.campaign import Campaign
from gcs.campaign.case import Case, Flown, make_course
from gcs.campaign.fly import fly_campaign, missing_cases
from gcs.campaign.summary import summarise
from gcs.campaign.table import Table
from gcs.figures.campaign import draw_campaign
from gcs.rehearsal import RehearsalOptions, rehearse_plan
from gcs.report import report_on
from planner.jobs.run_jobs import Failure


class Here(Executor):
    """Runs at once, in this process."""

    def submit(self, fn, /, case):  # type: ignore[no-untyped-def, override]
        future: Future[Flown] = Future()
        future.set_result(fn(case))
        return future


class OneByOne:
    at_once = 1

    @contextmanager
    def opened(self, at_once: int) -> Iterator[Executor]:
        yield Here()


@pytest.fixture(scope="module")
def table(campaign: Campaign, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Table]:
    """All flights, the campaign having been interrupted after three."""
    path = tmp_path_factory.mktemp("campaign") / "runs.csv"
    seen: list[Case] = []

    def interrupt(result: Flown | Failure[Case]) -> None:
        assert isinstance(result, Flown)
        seen.append(result.case)
        if len(seen) == 3:
            raise KeyboardInterrupt

    with Table(path, list(campaign.axes)) as first, pytest.raises(KeyboardInterrupt):
        fly_campaign(campaign, first, OneByOne(), interrupt)
    with Table(path, list(campaign.axes)) as second:
        assert len(missing_cases(campaign, second)) == 5
        fly_campaign(campaign, second, OneByOne(), lambda result: seen.append(result.case))  # type: ignore[union-attr]
        assert sorted(seen, key=str) == sorted(campaign.cases(), key=str), "each is flown once"
        yield second


def test_a_row_says_what_a_report_on_the_same_flight_says(campaign: Campaign, table: Table) -> None:
    row = table.row_of(Case((("formation.delay_s", 0.4), ("arm", "full")), 2))
    assert row is not None
    scenario, plan = campaign.scenario, campaign.plan
    truths, record = rehearse_plan(scenario, plan, RehearsalOptions(2, 0.4))
    report = report_on(scenario, plan, truths, record)
    formation = report.metrics["formation"]
    for column in ("rms_error_m", "max_error_m", "arrival_spread_s", "min_separation_m", "clearance_margin_m"):
        assert float(row[column]) == formation[column]
    assert row["trajectory_sha256"] == report.metrics["trajectory_sha256"]
    assert (row["arrived"], row["shortfalls"]) == ("3", str(len(report.shortfalls)))


def test_seeds_delays_and_arms_are_other_flights(table: Table) -> None:
    hashes = [row["trajectory_sha256"] for row in table.rows.values()]
    assert len(set(hashes)) == 6, "a plain autopilot knows no delay"


def test_a_summary_has_a_line_for_every_combination(campaign: Campaign, table: Table) -> None:
    settings = summarise(campaign, table)
    assert [setting.values for setting in settings] == [
        {"formation.delay_s": delay, "arm": arm} for delay in ("0.2", "0.4") for arm in ("full", "plain")
    ]
    full, plain = settings[0], settings[1]
    assert (full.flights, full.incomplete) == (2, 0)
    assert full.rms_error_m is not None
    assert plain.rms_error_m is not None
    assert full.rms_error_m[0] <= full.rms_error_m[1] <= full.rms_error_m[2] < plain.rms_error_m[0]
    assert len(summarise(replace(campaign, seeds=range(7, 9)), table)) == 0


def test_a_picture_for_each_axis_but_the_arms_which_are_colours(
    campaign: Campaign, table: Table, tmp_path: Path
) -> None:
    (file,) = draw_campaign(campaign, table, tmp_path)
    assert file.name == "campaign-formation-delay_s.png"
    assert file.stat().st_size > 10_000


def test_other_sources_refuse(campaign: Campaign) -> None:
    course = replace(make_course(campaign.scenario, campaign.plan), sources="0" * 16)
    with pytest.raises(RuntimeError, match="another version of skein"):
        course.fly(Case((), 1))
