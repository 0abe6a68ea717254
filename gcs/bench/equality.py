"""Rehearsal and flight, bit for bit: shipped scenarios on a bad network, at several speeds, beside other work."""

import asyncio
import multiprocessing
import os
import tempfile
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from gcs.campaign.axes import with_values
from gcs.flight import FlightOptions, fly
from gcs.rehearsal import RehearsalOptions, rehearse_plan
from gcs.report import report_on, write_report
from gcs.run_folder import make_run_folder
from gcs.watch import VehicleStatus
from missions.scenario import load_scenario
from planner.plan import plan

SCENARIOS = ("radars", "mountains", "vee")
SPEEDS = (float("inf"), 25.0, 12.0)
BAD_NETWORK: dict[str, Any] = {
    "channel": {"jitter_s": 0.3, "loss": 0.1, "bursts": {"every_s": 60.0, "length_s": 3.0}},
    "failures": [
        {"what": "silence", "at_s": 50.0, "for_s": 10.0},
        {"what": "freeze", "at_s": 80.0, "for_s": 20.0, "vehicles": [2]},
        {"what": "split", "at_s": 110.0, "for_s": 30.0, "groups": [[1, 2, 3]]},
        {"what": "kill", "at_s": 150.0, "vehicles": [5]},
    ],
    "formation.swarm_clock": True,
}


@dataclass(frozen=True)
class Equality:
    """One scenario.

    Attributes:
        rehearsed: trajectory_sha256 of the rehearsal.
        flown: by the speed asked for, that of the flight, and how fast that was in fact.
    """

    scenario: str
    rehearsed: str | None
    flown: dict[str, tuple[str | None, float]]

    @property
    def same(self) -> bool:
        """Whether all flew the same."""
        return self.rehearsed is not None and {sha256 for sha256, _ in self.flown.values()} == {self.rehearsed}


def measure_equality() -> list[Equality]:
    """Rehearse and fly each scenario, with other work on all cores."""
    with busy(os.cpu_count() or 1):
        return [_measured(name) for name in SCENARIOS]


@contextmanager
def busy(processes: int) -> Iterator[None]:
    """So many processes that do nothing of use."""
    with ExitStack() as stack:
        for _ in range(processes):
            process = multiprocessing.get_context("spawn").Process(target=_waste_time, daemon=True)
            process.start()
            stack.callback(process.kill)
        yield


def _waste_time() -> None:
    parent = multiprocessing.parent_process()
    while parent is not None and parent.is_alive():
        pass


def _measured(name: str) -> Equality:
    scenario = with_values(load_scenario(name), BAD_NETWORK)
    found = plan(scenario)
    delay_s = scenario.formation.delay_s
    truths, record = rehearse_plan(scenario, found, RehearsalOptions(found.seed, delay_s))
    rehearsed = report_on(scenario, found, truths, record).metrics
    flown = {}
    for speed in SPEEDS:
        with tempfile.TemporaryDirectory() as folder:
            run = make_run_folder(Path(folder) / name, name)
            options = FlightOptions(delay_s, speed=speed)
            flight = asyncio.run(fly(scenario, found, run, options, _ignore, _show_nothing))
            metrics = write_report(run, scenario, found, flight).metrics
        flown[f"{speed:g}"] = (metrics["trajectory_sha256"], metrics["timing"]["real_time_factor"])
    return Equality(name, rehearsed["trajectory_sha256"], flown)


def _ignore(line: str) -> None:
    pass


def _show_nothing(statuses: list[VehicleStatus]) -> None:
    pass
