"""Shared by the studies' tests: workers in this process, and a short flight's plan."""

from collections.abc import Iterator
from concurrent.futures import Executor, Future
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest

from missions.scenario import Scenario, load_scenario
from planner.formation_plan import FormationPlan
from planner.jobs.run_jobs import Workers
from planner.plan import plan


class Here(Executor):
    """Runs at once, in this process."""

    def submit(self, fn, /, *args):  # type: ignore[no-untyped-def, override]
        future: Future[Any] = Future()
        future.set_result(fn(*args))
        return future


class OneByOne:
    at_once = 1

    @contextmanager
    def opened(self, at_once: int) -> Iterator[Executor]:
        yield Here()


@pytest.fixture(scope="session")
def here() -> Workers:
    return OneByOne()


@pytest.fixture(scope="session")
def vee() -> Scenario:
    return load_scenario("vee")


@pytest.fixture(scope="session")
def vee_plan(vee: Scenario) -> FormationPlan:
    return plan(vee)


@pytest.fixture(scope="session")
def short(short_scenario: Path) -> Scenario:
    return load_scenario(str(short_scenario))


@pytest.fixture(scope="session")
def short_plan(short: Scenario) -> FormationPlan:
    return plan(short)
