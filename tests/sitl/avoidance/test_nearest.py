"""How near two predictions come: as a fine sampling of both finds."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from sitl.avoidance.intent import AHEAD, POINTS, STEP_S
from sitl.avoidance.nearest import FAR_M, least_distance

Places = list[list[float]]
speeds = st.tuples(st.floats(-36.0, 36.0), st.floats(-36.0, 36.0), st.floats(-4.0, 4.0))
starts = st.tuples(st.floats(-800.0, 800.0), st.floats(-800.0, 800.0), st.floats(0.0, 200.0))


def straight(start: tuple[float, ...], speed: tuple[float, ...], count: int) -> Places:
    return [[p + v * i * STEP_S for p, v in zip(start, speed, strict=True)] for i in range(count)]


@given(starts, speeds, starts, speeds, st.integers(0, 30), st.floats(0.5, 1.5))
def test_it_is_what_a_fine_sampling_of_two_straight_flights_finds(
    start: tuple[float, ...],
    speed: tuple[float, ...],
    other_start: tuple[float, ...],
    other_speed: tuple[float, ...],
    age_s: int,
    pace: float,
) -> None:
    own, other = straight(start, speed, AHEAD), straight(other_start, other_speed, POINTS)
    distance, in_s = least_distance(own, AHEAD, other, POINTS, float(age_s), pace, 0)
    t = np.linspace(0.0, min((AHEAD - 1) * STEP_S, (POINTS - 2) * STEP_S / pace - age_s - STEP_S), 4001)[:, None]
    apart = np.linalg.norm(
        np.array(start) + np.array(speed) * t - np.array(other_start) - np.array(other_speed) * (t + age_s) * pace,
        axis=1,
    )
    there = np.array(start) + np.array(speed) * in_s
    assert distance <= apart.min() + 1e-6
    assert distance == pytest.approx(
        np.linalg.norm(there - np.array(other_start) - np.array(other_speed) * (in_s + age_s) * pace), abs=1e-6
    )


def test_beyond_what_either_has_told_nobody_is_near() -> None:
    here = straight((0.0, 0.0, 0.0), (30.0, 0.0, 0.0), AHEAD)
    assert least_distance(here, 1, here, AHEAD, 0.0, 1.0, 0)[0] == FAR_M
    assert least_distance(here, AHEAD, here, 3, 6.0, 1.0, 0)[0] == FAR_M


def test_what_comes_too_soon_to_change_may_be_left_out() -> None:
    own = straight((0.0, 0.0, 0.0), (30.0, 0.0, 0.0), AHEAD)
    other = straight((10.0, 0.0, 0.0), (30.0, 10.0, 0.0), POINTS)
    assert least_distance(own, AHEAD, other, POINTS, 0.0, 1.0, 0)[0] == pytest.approx(10.0)
    assert least_distance(own, AHEAD, other, POINTS, 0.0, 1.0, 2)[0] > 60.0
