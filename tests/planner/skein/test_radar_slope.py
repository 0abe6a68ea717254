"""The slope of a leg's radar cost against finite differences of that cost."""

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from planner.cost.radar import radar_integral_m
from planner.skein.radar_slope import add_radar_slope

RADIUS_M = 1500.0
STEP_M = 1e-3


@settings(max_examples=200, deadline=None)
@given(
    seed=st.integers(0, 2**32),
    kind=st.sampled_from(["anywhere", "inside", "through", "near the centre", "far beyond"]),
)
def test_slope_agrees_with_finite_differences(seed: int, kind: str) -> None:
    rng = np.random.default_rng(seed)
    radar = np.array([4000.0, -2000.0, 900.0, RADIUS_M, RADIUS_M * rng.uniform(0.3, 1.2)])
    p, q = rng.normal(size=(2, 3)) * RADIUS_M
    match kind:
        case "inside":
            p, q = 0.3 * p, 0.3 * q
        case "through":
            q = -rng.uniform(0.5, 2.0) * p + 0.5 * q
        case "near the centre":
            q = -rng.uniform(0.5, 2.0) * p + 10 ** rng.uniform(-2.0, -1.0) * q
        case "far beyond":
            p, q = 20.0 * p, -15.0 * p + 0.5 * q
    ends = np.array([p, q]) + radar[:3]
    slopes = np.zeros((2, 3))
    add_radar_slope(*ends, radar, *slopes)
    here = radar_integral_m(*ends, radar)
    expected = np.zeros((2, 3))
    for end, axis in np.ndindex(2, 3):
        one_sided = []
        for step in (STEP_M, -STEP_M):
            moved = ends.copy()
            moved[end, axis] += step
            one_sided.append((radar_integral_m(*moved, radar) - here) / step)
        assume(abs(one_sided[0] - one_sided[1]) <= 1e-3 * (1e-3 + max(map(abs, one_sided))))
        expected[end, axis] = np.mean(one_sided)
    assert slopes == pytest.approx(expected, abs=3e-3 * (1e-3 + np.abs(expected).max()))


def test_a_leg_outside_has_no_slope() -> None:
    slopes = np.zeros((2, 3))
    radar = np.array([0.0, 0.0, 0.0, RADIUS_M, RADIUS_M])
    add_radar_slope(np.array([-3000.0, 1501.0, 0.0]), np.array([3000.0, 1501.0, 0.0]), radar, *slopes)
    assert not slopes.any()


def test_it_adds_to_what_is_there() -> None:
    radar = np.array([0.0, 0.0, 0.0, RADIUS_M, RADIUS_M])
    p, q = np.array([-3000.0, 700.0, 0.0]), np.array([3000.0, 700.0, 0.0])
    once, twice = np.zeros((2, 3)), np.zeros((2, 3))
    add_radar_slope(p, q, radar, *once)
    for _ in range(2):
        add_radar_slope(p, q, radar, *twice)
    assert once[0, 1] < 0.0  # further away is cheaper
    assert twice == pytest.approx(2.0 * once)
