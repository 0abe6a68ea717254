"""Runs to look at, and a server to look at them with."""

from collections.abc import Callable, Iterator
from contextlib import ExitStack
from pathlib import Path
from typing import Any

import pytest
import viser

from gcs.console.server import close_server, open_server
from gcs.rehearsal import RehearsalOptions, rehearse_plan
from gcs.report import write_report
from gcs.report_page import FlownRun, read_flown_run
from gcs.run_folder import make_run_folder
from gcs.truth import write_truths
from missions.scenario import Scenario
from planner.formation_plan import FormationPlan

LOOPBACK = "127.0.0.1"


@pytest.fixture(scope="session")
def keep_run(tmp_path_factory: pytest.TempPathFactory) -> Callable[..., Path]:
    """Flies a plan by rehearsal and keeps the run."""

    def keep(scenario: Scenario, text: str, plan: FormationPlan) -> Path:
        run = make_run_folder(tmp_path_factory.mktemp("flown") / scenario.name, scenario.name)
        run.write_plan(text, scenario, plan)
        run.begin_flight()
        truths, record = rehearse_plan(scenario, plan, RehearsalOptions(7, 0.2))
        write_truths(truths, run.truth)
        write_report(run, scenario, plan, record)
        return run.path

    return keep


@pytest.fixture(scope="session")
def flown_path(keep_run: Callable[..., Path], short: Scenario, short_scenario: Path, short_plan: FormationPlan) -> Path:
    """The short scenario, flown."""
    return keep_run(short, short_scenario.read_text(), short_plan)


@pytest.fixture(scope="session")
def flown(flown_path: Path) -> FlownRun:
    return read_flown_run(flown_path)


@pytest.fixture(scope="module")
def serve_pages() -> Iterator[Callable[..., viser.ViserServer]]:
    """Opens servers, on a free port unless told otherwise."""
    with ExitStack() as stack:

        def open_one(host: str = LOOPBACK, port: int = 0, token: str | None = None) -> Any:
            server = open_server(host, port, token)
            stack.callback(close_server, server)
            return server

        yield open_one
