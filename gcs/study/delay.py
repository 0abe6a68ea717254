"""The study of delay: the linear law, aircraft over delay, channels, pins, and a line; as tables and pictures."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from gcs.delay_margin import delay_margin_s
from gcs.figures.delay_study import draw_aircraft, draw_channels, draw_line, draw_linear, draw_pins
from gcs.study.delay_trials import channel_trials, delay_trials, pin_trials, with_graph
from gcs.study.fly import fly_trials
from gcs.study.graphs import Graph
from gcs.study.linear_sweep import Amplification, Growth, amplifications, growths, pin_growths
from gcs.study.points import Point, points_of
from gcs.study.table import write_table
from gcs.study.trial import Trial
from missions.scenario import Scenario
from planner.formation_plan import FormationPlan
from planner.jobs.run_jobs import Workers

Row = Mapping[str, str | float]


@dataclass(frozen=True)
class DelayStudy:
    """What a study found.

    Attributes:
        scenario: that was studied.
        growths: of the linear law, by graph and law.
        margins_s: of aircraft, by graph.
        aircraft: curves (graph, arm) over delay, s.
        channels: curves (what,) over how much of it.
        pin_growths: of the linear law on the scenario's graph; "all" or "one" stands for the law.
        pins: curves ("all" or "one",) over delay, s.
        line: what travels along a line.
    """

    scenario: Scenario
    growths: list[Growth]
    margins_s: dict[str, float]
    aircraft: list[Point]
    channels: list[Point]
    pin_growths: list[Growth]
    pins: list[Point]
    line: list[Amplification]

    def tables(self) -> dict[str, list[Row]]:
        """Rows by the name of their table."""
        return {
            "linear": [{**asdict(growth), "share": growth.share} for growth in self.growths],
            "aircraft": [
                {"margin_s": self.margins_s[point.curve[0]], **point.row(("graph", "arm"), "delay_s")}
                for point in self.aircraft
            ],
            "channels": [point.row(("channel",), "level") for point in self.channels],
            "pins_linear": [
                {"pinned": growth.law, "delay_s": growth.delay_s, "rate_1_s": growth.rate_1_s}
                for growth in self.pin_growths
            ],
            "pins_aircraft": [point.row(("pinned",), "delay_s") for point in self.pins],
            "line": [
                {"pinned": one.pinned, "share": one.share, "edge": i + 1, "error_s2": error, "speed_s": speed}
                for one in self.line
                for i, (error, speed) in enumerate(zip(one.errors_s2, one.speeds_s, strict=True))
            ],
        }

    def write(self, folder: Path) -> list[Path]:
        """Write a table and a picture for each part into an existing folder; returns the files. Raises OSError."""
        files = [write_table(rows, folder / f"{name}.csv") for name, rows in self.tables().items()]
        name, delay_s = self.scenario.name, self.scenario.formation.delay_s
        pictures = {part: folder / f"{part}.png" for part in ("linear", "aircraft", "channels", "pins", "line")}
        draw_linear(name, self.growths, pictures["linear"])
        draw_aircraft(name, self.aircraft, self.margins_s, delay_s, pictures["aircraft"])
        draw_channels(name, self.channels, delay_s, pictures["channels"])
        draw_pins(name, self.pin_growths, self.pins, delay_margin_s(self.scenario), pictures["pins"])
        draw_line(name, self.line, pictures["line"])
        return files + list(pictures.values())

    def as_json(self) -> dict[str, Any]:
        """Margins and tables as JSON values."""
        return {"scenario": self.scenario.name, "aircraft_margins_s": self.margins_s, **self.tables()}


def trials_of(
    scenario: Scenario, graphs: Mapping[str, Graph], shares: Sequence[float], seeds: Sequence[int]
) -> dict[str, list[Trial]]:
    """All flights of the study by part."""
    return {
        "aircraft": delay_trials(scenario, graphs, shares, seeds),
        "channels": channel_trials(scenario, seeds),
        "pins": pin_trials(scenario, shares, seeds),
    }


def study_delay(
    scenario: Scenario,
    plan: FormationPlan,
    graphs: Mapping[str, Graph],
    trials: Mapping[str, list[Trial]],
    workers: Workers,
    told: Callable[[Trial], None],
) -> DelayStudy:
    """Simulate the linear law, and fly the trials, telling of each.

    Raises:
        RuntimeError: a flight gave no result.
    """
    flown = {part: points_of(fly_trials(scenario, plan, wanted, workers, told)) for part, wanted in trials.items()}
    return DelayStudy(
        scenario=scenario,
        growths=[growth for name, graph in graphs.items() for growth in growths(scenario, name, graph)],
        margins_s={name: delay_margin_s(with_graph(scenario, graph)) for name, graph in graphs.items()},
        aircraft=flown["aircraft"],
        channels=flown["channels"],
        pin_growths=pin_growths(scenario),
        pins=flown["pins"],
        line=amplifications(scenario),
    )
