"""Fields of many UAVs."""

import math
from itertools import pairwise

import pytest

from planner.bench.growth import LANE_M, Growth, exponent, field, measure_growth
from planner.plan import plan
from planner.verify import verify


def test_a_field_has_lanes_and_threats_as_far_as_it_is_wide() -> None:
    few, many = field(3), field(40)
    assert len(many.vehicles) == 40
    origins = [vehicle.origin for vehicle in many.vehicles]
    assert all(b[1] - a[1] == LANE_M for a, b in pairwise(origin for origin in origins if origin))
    assert len(many.radars) > len(few.radars)
    assert many.area.y_m[1] > few.area.y_m[1]


def test_more_uavs_than_a_formation_has_are_planned_and_verified() -> None:
    scenario = field(16)
    made = plan(scenario)
    assert len(made.uavs) == 16
    assert verify(made, scenario).violations == ()


def test_measured_is_what_was_planned() -> None:
    told: list[None] = []
    (growth,) = measure_growth([3], lambda: told.append(None))
    assert len(told) == 1
    assert growth.uavs == 3
    assert growth.cpu_s > 0.0


def test_the_exponent_of_a_power_law_is_found() -> None:
    growths = [Growth(n, 0.01 * math.pow(n, 1.2), 1.0) for n in (10, 20, 50)]
    assert exponent(growths) == pytest.approx(1.2)
