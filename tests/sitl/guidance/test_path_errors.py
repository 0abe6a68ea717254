"""Deviations from a path are found by one Newton step a tick."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from missions.reference import ReferenceTables, fillet
from missions.reference.smoothing import moving_average
from sitl.guidance.path_errors import START, ScheduleClock, path_errors

CORNERS = np.array([[0, 0], [2000, 0], [3500, 1500.0], [6000, 1500]])
PATH = fillet(CORNERS, 200)
SPEED = 25.0
TABLES = ReferenceTables(
    segments=PATH.segments.tolist(),
    altitude=moving_average(PATH.corner_s_m, np.array([100.0, 200, 200, 250]), 120).tolist(),
    schedule=moving_average(np.array([0.0, PATH.length_m / SPEED]), np.array([0.0, PATH.length_m]), 8).tolist(),
    airspeeds=[(0.0, SPEED)],
    length_m=PATH.length_m,
    duration_s=PATH.length_m / SPEED,
)


@given(st.floats(0, 1), st.floats(-40, 40), st.floats(-20, 20))
def test_a_place_beside_the_path_is_found_again(share: float, left: float, late_s: float) -> None:
    s = share * PATH.length_m
    x, y, heading, curvature = (float(v) for v in PATH.at(np.array(s)))
    position = (x - left * math.sin(heading), y + left * math.cos(heading), 150.0)
    ground_speed = SPEED * (1 - curvature * left)
    velocity = (ground_speed * math.cos(heading), ground_speed * math.sin(heading), 0.0)
    point = START._replace(s_m=s - 1.0)
    for _ in range(3):
        errors, point = path_errors(position, velocity, ScheduleClock(s / SPEED + late_s, 1.0, 0.0), point, TABLES)
    assert point.s_m == pytest.approx(s, abs=0.02)
    assert errors.across == pytest.approx(left, abs=0.02)
    assert errors.along == pytest.approx(-SPEED * late_s, abs=0.05)
    assert errors.along_rate == pytest.approx(0, abs=0.1)


def test_one_step_a_tick_follows_a_flight_along_an_arc() -> None:
    """At 30 m/s a tick is 1.2 m; the projection stays within a centimetre of the true one."""
    point, worst = START, 0.0
    for n in range(int(PATH.length_m / 1.2)):
        s = 1.2 * n
        x, y, heading, _ = (float(v) for v in PATH.at(np.array(s)))
        velocity = (30 * math.cos(heading), 30 * math.sin(heading), 0.0)
        _, point = path_errors((x, y, 0.0), velocity, ScheduleClock(0.0, 1.0, 0.0), point, TABLES)
        worst = max(worst, abs(point.s_m - s))
    assert worst < 0.01


@given(st.floats(0.1, 0.9), st.floats(0.7, 1.3), st.floats(-0.5, 0.5))
def test_against_a_slowed_clock_speed_and_acceleration_are_those_of_its_schedule(
    share: float, rate: float, change: float
) -> None:
    s = share * PATH.length_m
    x, y, heading, _ = (float(v) for v in PATH.at(np.array(s)))
    velocity = (rate * SPEED * math.cos(heading), rate * SPEED * math.sin(heading), 0.0)
    point = START._replace(s_m=s - 1.0)
    for _ in range(3):
        errors, point = path_errors((x, y, 150.0), velocity, ScheduleClock(s / SPEED, rate, change), point, TABLES)
    assert errors.along == pytest.approx(0.0, abs=0.05)
    assert errors.along_rate == pytest.approx(0.0, abs=0.1)
    assert errors.reference_acceleration == pytest.approx(SPEED * change, abs=0.05)
