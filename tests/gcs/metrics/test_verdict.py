from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from gcs.flight_record import FlightRecord
from gcs.metrics import Metrics, measure, shortfalls
from missions.reference import Reference
from missions.scenario import Scenario
from planner.formation_plan import FormationPlan

Fly = Callable[[dict[int, Reference]], dict[int, np.ndarray]]


@pytest.fixture(scope="module")
def pair(radars: Scenario, few: Callable[[Scenario, int], Scenario]) -> Scenario:
    """The leader and F1, which on straight lines meet radars and walls; without the latter."""
    return Scenario.model_validate(few(radars, 2).model_dump() | {"obstacles": (), "radars": ()})


@pytest.fixture(scope="module")
def fine(
    pair: Scenario,
    straight_plan: Callable[[Scenario], FormationPlan],
    fly_exactly: Fly,
    make_record: Callable[..., FlightRecord],
) -> Metrics:
    plan = straight_plan(pair)
    truths = fly_exactly(plan.references(pair))
    return measure(pair, plan, truths, ((1, 2),), make_record(plan))[0]


def test_a_flight_as_planned_falls_short_of_nothing(fine: Metrics, pair: Scenario) -> None:
    assert shortfalls(fine, pair) == []


@pytest.mark.parametrize(
    ("change", "line"),
    [
        ({"lost_s": 71.25, "completed": False}, "leader: lost after 71.2 s"),
        ({"completed": False}, "leader: did not arrive at its target"),
        ({"items_verified": 2}, "leader: 2 of 3 mission items verified"),
    ],
)
def test_says_what_a_vehicle_did_not_do(fine: Metrics, pair: Scenario, change: dict[str, Any], line: str) -> None:
    vehicles = (replace(fine.vehicles[0], **change), fine.vehicles[1])
    assert shortfalls(replace(fine, vehicles=vehicles), pair) == [line]


@pytest.mark.parametrize(
    ("change", "line"),
    [
        ({"min_separation_m": 199.0}, "separation: 199 m at the least, limits.separation_m is 200"),
        ({"clearance_margin_m": -11.0}, "clearance: 11 m less than limits.clearance_m asks for"),
        ({"min_wall_m": 89.0}, "obstacles: 89 m at the least, limits.obstacle_margin_m is 100"),
    ],
)
def test_says_what_the_swarm_came_too_close_to(
    fine: Metrics, pair: Scenario, change: dict[str, Any], line: str
) -> None:
    assert shortfalls(replace(fine, formation=replace(fine.formation, **change)), pair) == [line]


def test_tracking_within_its_band_is_no_shortfall(fine: Metrics, pair: Scenario) -> None:
    formation = replace(fine.formation, clearance_margin_m=-9.0, min_wall_m=91.0, min_separation_m=200.0)
    assert shortfalls(replace(fine, formation=formation), pair) == []


@pytest.mark.parametrize(
    ("change", "line"),
    [
        ({"airspeed_min_m_s": 14.0}, "F1: airspeed 14.0 m/s, airspeed_min_m_s is 18"),
        ({"airspeed_max_m_s": 39.5}, "F1: airspeed 39.5 m/s, airspeed_max_m_s is 36"),
        ({"climb_rate_min_m_s": -4.6}, "F1: climb rate -4.6 m/s, climb_rate_min_m_s is -4"),
        ({"climb_rate_max_m_s": 5.6}, "F1: climb rate 5.6 m/s, climb_rate_max_m_s is 5"),
        ({"airspeed_max_m_s": 28.0, "turn_rate_max_deg_s": 51.0}, "F1: turn rate 51 deg/s, load_factor_max allows 50"),
    ],
)
def test_says_which_limit_of_the_aircraft_was_passed(
    fine: Metrics, pair: Scenario, change: dict[str, Any], line: str
) -> None:
    limits = (fine.limits[0], replace(fine.limits[1], **change))
    assert shortfalls(replace(fine, limits=limits), pair) == [line]


def test_a_gust_below_the_least_airspeed_is_no_shortfall(fine: Metrics, pair: Scenario) -> None:
    limits = (fine.limits[0], replace(fine.limits[1], airspeed_min_m_s=17.1))
    assert shortfalls(replace(fine, limits=limits), pair) == []
