"""The study of delay, small: a few flights of a short scenario."""

import csv
import json
from pathlib import Path

import pytest
from rich.console import Console
from typer.testing import CliRunner

from gcs.cli import app
from gcs.cli.study_table import delay_table
from gcs.delay_margin import delay_margin_s
from gcs.study.delay import study_delay, trials_of
from gcs.study.delay_trials import BURSTS_S, JITTERS_S, LOSSES, delays_s
from gcs.study.graphs import parse_edges, studied_graphs
from gcs.study.trial import Trial
from missions.errors import InputError
from missions.scenario import Scenario
from planner.formation_plan import FormationPlan
from planner.jobs.run_jobs import Workers
from sitl.ticks import TICK_S

SHARES = (0.5, 1.3)
ENDS = (0.0, max(JITTERS_S), max(LOSSES), max(BURSTS_S))


def test_a_study_flies_every_trial_and_keeps_a_table_and_a_picture_of_each_part(
    short: Scenario, short_plan: FormationPlan, here: Workers, tmp_path: Path
) -> None:
    graphs = {name: graph for name, graph in studied_graphs(short).items() if name in ("line", "custom")}
    trials = trials_of(short, graphs, SHARES, range(2))
    trials["channels"] = [trial for trial in trials["channels"] if trial.level in ENDS]
    told: list[Trial] = []
    found = study_delay(short, short_plan, graphs, trials, here, told.append)
    assert len(told) == sum(map(len, trials.values()))
    files = found.write(tmp_path)
    parts = ("linear", "aircraft", "channels", "pins", "line")
    assert {file.name for file in files} >= {f"{part}.png" for part in parts}
    with (tmp_path / "aircraft.csv").open() as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == len(graphs) * (len(SHARES) + 2)
    assert all(row["flights"] == "2" and row["incomplete"] == "0" for row in rows)
    full = {float(row["delay_s"]): float(row["relative_speed_m_s"]) for row in rows if row["arm"] == "full"}
    assert full[max(full)] > full[min(full)], "past the margin it rings"
    assert json.dumps(found.as_json(), allow_nan=False)
    console = Console(width=80, record=True)
    console.print(delay_table(found))
    assert max(map(len, console.export_text().splitlines())) <= 80


def test_delays_are_whole_ticks_on_their_side_of_the_margin(short: Scenario) -> None:
    margin_s = delay_margin_s(short)
    below, above = delays_s(margin_s, (0.95, 1.05))
    assert below < margin_s < above
    assert below / TICK_S == pytest.approx(round(below / TICK_S))


@pytest.mark.parametrize("text", ["1-2,x", "1", "2-2", "1-2,2-9", "1-2"])
def test_edges_that_are_none_or_do_not_connect_are_told_of(text: str, short: Scenario) -> None:
    with pytest.raises(InputError, match="--edges"):
        studied_graphs(short, parse_edges(text))


def test_the_command_refuses_bad_edges_with_exit_code_2() -> None:
    result = CliRunner().invoke(app, ["study", "delay", "vee", "--edges", "1-2"])
    assert result.exit_code == 2
