"""`skein report`: one page of a flight, which needs nothing else, or of two side by side."""

import re
import shutil
from collections.abc import Callable
from dataclasses import replace
from html.parser import HTMLParser
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from typer.testing import CliRunner

from gcs.cli import app
from gcs.metrics import Check
from gcs.rehearsal import RehearsalOptions, rehearse_plan
from gcs.report import report_on, write_report
from gcs.report_page import FlownRun, read_flown_run, write_page
from gcs.report_page.delays import delay_curve, delay_trials_of
from gcs.report_page.page import CheckRow, rows_of
from gcs.run_folder import RunFolder
from gcs.truth import write_truths
from missions.errors import InputError
from missions.scenario import Scenario, parse_scenario, read_scenario_text
from planner.formation_plan import FormationPlan
from planner.jobs.processes import Processes
from planner.plan import plan


@pytest.fixture(scope="module")
def keep_flight(
    short: Scenario, short_scenario: Path, short_plan: FormationPlan, tmp_path_factory: pytest.TempPathFactory
) -> Callable[..., Path]:
    """Keeps runs of the short scenario, flown with a delay and an arm."""

    def keep(name: str, delay_s: float = 0.2, arm: Any = "full") -> Path:
        run = RunFolder(tmp_path_factory.mktemp(name) / name)
        run.path.mkdir()
        run.write_plan(short_scenario.read_text(), short, short_plan)
        run.begin_flight()
        truths, record = rehearse_plan(short, short_plan, RehearsalOptions(7, delay_s, arm))
        write_truths(truths, run.truth)
        write_report(run, short, short_plan, record)
        return run.path

    return keep


@pytest.fixture(scope="module")
def path(keep_flight: Callable[..., Path]) -> Path:
    return keep_flight("first")


@pytest.fixture(scope="module")
def run(path: Path) -> FlownRun:
    return read_flown_run(path)


class Page(HTMLParser):
    """What a page shows, and what it would load."""

    def __init__(self, file: Path) -> None:
        super().__init__()
        self.loads: list[str] = []
        self.ids: list[str] = []
        self._texts: list[str] = []
        self._hidden = 0
        self.feed(file.read_text(encoding="utf-8"))
        self.text = " ".join(" ".join(self._texts).split())

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self._hidden += tag in ("script", "style", "svg")
        values = dict(attrs)
        self.loads += [value for key in ("src", "href", "xlink:href") if (value := values.get(key))]
        if (name := values.get("id")) is not None:
            self.ids.append(name)

    def handle_endtag(self, tag: str) -> None:
        self._hidden -= tag in ("script", "style", "svg")

    def handle_data(self, data: str) -> None:
        if not self._hidden:
            self._texts.append(data)


def test_the_page_needs_nothing_else_and_says_what_the_metrics_say(path: Path, run: FlownRun) -> None:
    result = CliRunner().invoke(app, ["report", str(path), "--no-delays"])
    assert result.exit_code == 0, result.output
    page = Page(path / "report.html")
    assert page.loads
    assert all(address.startswith(("#", "data:")) for address in page.loads)
    assert len(page.ids) == len(set(page.ids))
    assert {address[1:] for address in page.loads if address.startswith("#")} <= set(page.ids)
    formation = run.metrics.formation
    for said in (
        "All well",
        f"formation error {formation.rms_error_m:.2f} m",
        f"least separation {formation.min_separation_m:.0f} m",
        run.metrics.trajectory_sha256,
        "skein plan short.toml --seed",
        "[[vehicles]]",
    ):
        assert str(said) in page.text
    for vehicle in run.metrics.vehicles:
        assert f"{vehicle.sysid} {vehicle.name}" in page.text
        assert f"{vehicle.fitness:.3f}" in page.text


def test_two_runs_stand_side_by_side(path: Path, keep_flight: Callable[..., Path], tmp_path: Path) -> None:
    other, out = keep_flight("other", delay_s=0.4, arm="plain"), tmp_path / "both.html"
    result = CliRunner().invoke(app, ["report", str(path), "--compare", str(other), "--no-delays", "--out", str(out)])
    assert result.exit_code == 0, result.output
    page = Page(out)
    assert len(page.ids) == len(set(page.ids))
    for one in (path, other):
        error_m = read_flown_run(one).metrics.formation.rms_error_m
        assert f"{error_m:.2f} m" in page.text
    assert re.search(r"--delay 0.4 --no-corrections", page.text)


def test_the_flight_lies_on_the_curve_of_its_rehearsals(run: FlownRun) -> None:
    trials = [trial for trial in delay_trials_of(run) if trial.level <= run.metrics.delay_s]
    told: list[None] = []
    curve = dict(delay_curve(run, trials, Processes(1), lambda: told.append(None)))
    assert curve[run.metrics.delay_s] == run.metrics.formation.rms_error_m
    assert len(told) == len(curve) == len(trials) > 1


def test_a_flight_is_drawn_against_the_places_that_were_taken(tmp_path: Path) -> None:
    text = read_scenario_text("vee")[0].replace("[formation]", "[formation]\nreassign = true")
    text += '\n[[failures]]\nwhat = "kill"\nat_s = 100.0\nvehicles = [3]\n'
    scenario = parse_scenario(text, "vee.toml")
    planned = plan(scenario)
    run = RunFolder(tmp_path)
    run.write_plan(text, scenario, planned)
    run.begin_flight()
    truths, record = rehearse_plan(scenario, planned, RehearsalOptions(1, 0.2))
    write_truths(truths, run.truth)
    run.write_json("metrics.json", report_on(scenario, planned, truths, record).metrics)
    flown = read_flown_run(tmp_path)
    assert any(vehicle.place != vehicle.sysid for vehicle in flown.metrics.vehicles)
    assert flown.series.error.overall_rms_m == flown.metrics.formation.rms_error_m
    apart_m = flown.series.planned_separation_m
    assert np.nanmin(apart_m) > scenario.limits.separation_m


def test_what_fell_short_comes_first(run: FlownRun, tmp_path: Path) -> None:
    bad = Check("least separation", "3 m", "200 m", -197.0, "separation: <3> m at the least")
    write_page([(replace(run, checks=[*run.checks, bad]), [])], tmp_path / "page.html")
    text = Page(tmp_path / "page.html").text
    assert "separation: <3> m at the least" in text  # and not taken for markup
    assert "FAIL least separation 3 m" in text
    assert "All well" not in text


def test_of_all_vehicles_the_one_with_the_least_room_is_shown() -> None:
    found = [Check("climb", f"{room} m/s", "", room, "") for room in (3.0, -1.0, 2.0)]
    far = Check("arrival", "there", "", 0.0, "")
    assert rows_of([far, *found]) == [CheckRow(far, True, 1), CheckRow(found[1], False, 3)]


@pytest.mark.parametrize(
    ("spoil", "said"),
    [
        (lambda run: (run / "metrics.json").unlink(), "has the run been flown"),
        (lambda run: (run / "metrics.json").write_text('{"seed": 1'), "metrics.json"),
        (lambda run: (run / "metrics.json").write_text('{"seed": "x"}'), "metrics.json: "),
        (lambda run: [file.unlink() for file in (run / "truth").iterdir()], "no vehicle's truth"),
        (lambda run: (run / "scenario.toml").unlink(), "is .* a run"),
    ],
)
def test_what_cannot_be_read_is_named(path: Path, tmp_path: Path, spoil: Callable[[Path], Any], said: str) -> None:
    spoilt = shutil.copytree(path, tmp_path / "spoilt")
    spoil(spoilt)
    with pytest.raises(InputError, match=said):
        read_flown_run(spoilt)
    assert CliRunner().invoke(app, ["report", str(spoilt)]).exit_code == 2
