"""Runs by hand in all scenarios that ship: ways with turns, written as the planner writes them, without a search."""

import math
from collections.abc import Callable

import numpy as np
import pytest

from missions.reference.reference import fillet_radius_m
from missions.scenario import Scenario, VehicleModel, load_scenario, shipped_scenarios
from planner.formation_plan import FitnessTerms, FormationPlan, UavPlan
from planner.loiter import Circle
from planner.schedule import Schedule
from planner.write_mission import write_mission

AIRSPEEDS_M_S = np.array([26.0, 25.0, 25.5])


@pytest.fixture(scope="module", params=shipped_scenarios())
def scenario(request: pytest.FixtureRequest) -> Scenario:
    return load_scenario(request.param)


@pytest.fixture(scope="module")
def formation(scenario: Scenario) -> FormationPlan:
    return by_hand(scenario)


@pytest.fixture(scope="session")
def plan_by_hand() -> Callable[[Scenario], FormationPlan]:
    return by_hand


def by_hand(scenario: Scenario) -> FormationPlan:
    """A formation whose vehicles turn left and right on their ways to their targets."""
    uavs = tuple(_uav(scenario, vehicle) for vehicle in scenario.vehicles)
    return FormationPlan(scenario.name, 1, "by hand", uavs, compile_s=0.0, plan_s=0.0)


def _uav(scenario: Scenario, vehicle: VehicleModel) -> UavPlan:
    start, end = np.array(scenario.origin_m(vehicle)), np.array(scenario.target_m(vehicle))
    aside = 0.05 * np.array([start[1] - end[1], end[0] - start[0], 0.0])
    corners = np.array([start, start + 0.4 * (end - start) + aside, start + 0.7 * (end - start) - aside, end])
    arcs = np.hypot(*np.diff(corners[:, :2], axis=0).T)
    schedule = Schedule(arcs, np.diff(corners[:, 2]) / arcs, AIRSPEEDS_M_S, AIRSPEEDS_M_S)
    circle = Circle(*end.tolist(), math.ceil(fillet_radius_m(float(AIRSPEEDS_M_S.max()))))
    mission = write_mission(corners, schedule, circle, scenario.frame)
    length_m = float(arcs.sum())
    return UavPlan(
        *(vehicle.sysid, vehicle.name, corners, FitnessTerms(length_m / 1000.0, 0.0, 0.0, 0.0, 0.0)),
        *(math.dist(start, end), length_m, 1, (), mission),
    )
