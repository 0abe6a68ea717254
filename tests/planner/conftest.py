"""Small scenarios for tests of planning."""

from collections.abc import Callable, Sequence
from typing import Any

import pytest

from missions.scenario import Scenario, load_scenario

Point = tuple[float, float, float]

RADARS = load_scenario("radars")


def _small(lines: Sequence[tuple[Point, Point]] | None = None, *, waypoints: int = 12, **changes: Any) -> Scenario:
    search = RADARS.search.model_copy(update={"population": 50, "iterations": 40, "waypoints": waypoints})
    vehicles = RADARS.vehicles
    if lines is not None:
        vehicles = tuple(
            vehicles[0].model_copy(update={"name": f"U{i + 1}", "sysid": i + 1, "origin": origin, "target": target})
            for i, (origin, target) in enumerate(lines)
        )
    scenario = RADARS.model_copy(update={"search": search, "vehicles": vehicles, **changes})
    scenario.__dict__.pop("environment", None)  # cached, of the scenario that was copied
    return scenario


@pytest.fixture(scope="session")
def small_scenario() -> Callable[..., Scenario]:
    """`radars` with a small budget; with other vehicles U1, U2, ... when lines (origin, target) are given."""
    return _small
