"""Random flights for the proofs."""

from collections.abc import Callable

import numpy as np
import pytest

from missions.reference import Reference, build_reference
from missions.scenario import Scenario, load_scenario
from planner.loiter import Circle
from planner.schedule import timed_schedule
from planner.write_mission import write_mission

MakeReferences = Callable[..., list[Reference]]


@pytest.fixture(scope="session")
def radars() -> Scenario:
    return load_scenario("radars")


@pytest.fixture(scope="session")
def make_references(radars: Scenario) -> MakeReferences:
    """References of `count` UAVs that wander about one line, turning, climbing and changing speed at each corner."""

    def make(seed: int, count: int, legs: int = 4, leg_m: float = 700.0, spread_m: float = 250.0) -> list[Reference]:
        rng = np.random.default_rng(seed)
        found = []
        for _ in range(count):
            x = np.arange(legs + 1) * leg_m
            y = rng.uniform(-spread_m, spread_m, legs + 1)
            z = 300.0 + rng.uniform(-30.0, 30.0, legs + 1)
            corners = np.column_stack([x, y, z])
            times = np.concatenate([[0.0], np.cumsum(np.hypot(leg_m, np.diff(y)) / rng.uniform(21.0, 33.0, legs))])
            schedule = timed_schedule(corners, times, radars.wind.forecast_m_s)
            mission = write_mission(corners, schedule, Circle(*corners[-1].tolist(), 200.0), radars.frame)
            airframe = radars.airframe.airframe()
            found.append(build_reference(mission, radars.frame, airframe, radars.wind.forecast_m_s))
        return found

    return make
