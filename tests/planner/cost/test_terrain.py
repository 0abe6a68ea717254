"""Nothing slips between the samples of a leg."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from missions.environment import Terrain, ground_heights_m
from missions.environment.terrain import NO_WAVE
from planner.cost.terrain import DIP_M, leg_clearance_m

WAVE = (60.0, 0.3, 0.8, 0.5, 1.1, 0.4, 0.9, 0.7)


def dense(p: np.ndarray, q: np.ndarray, terrain: Terrain) -> np.ndarray:
    x, y, z = (p + np.linspace(0, 1, 20001)[:, None] * (q - p)).T
    return z - ground_heights_m(x, y, terrain)


@settings(max_examples=80, deadline=None)
@given(seed=st.integers(0, 2**32), wave=st.sampled_from([NO_WAVE, WAVE]))
def test_least_clearance_is_found(seed: int, wave: tuple[float, ...]) -> None:
    rng = np.random.default_rng(seed)
    peaks = [(rng.uniform(-800, 1800), *rng.uniform(-4000, 4000, 2), *rng.uniform(80, 3000, 2)) for _ in range(3)]
    terrain = Terrain(10.0, wave, peaks).as_array()  # type: ignore[arg-type]
    p, q = rng.uniform((-5000, -5000, 0), (5000, 5000, 2000), (2, 3))
    least, _, shortfall, _ = leg_clearance_m(p, q, 5000.0, 9000.0, terrain, 100.0, 2000.0)
    truth = dense(p, q, terrain).min()
    assert truth - 0.01 <= least <= truth + DIP_M
    assert shortfall == 100.0 - least


def test_a_needle_on_a_long_leg_is_seen() -> None:
    terrain = Terrain(0.0, NO_WAVE, [(900.0, 3333.0, 5.0, 15.0, 15.0)]).as_array()
    p, q = np.array([0.0, 0, 500]), np.array([8000.0, 0, 500])
    least, _, _, _ = leg_clearance_m(p, q, 5000.0, 13000.0, terrain, 100.0, 2000.0)
    assert least < -290.0
    aside = np.array([0.0, 200.0, 0.0])
    beside, _, _, _ = leg_clearance_m(p + aside, q + aside, 5000.0, 13000.0, terrain, 100.0, 2000.0)
    assert beside == 500.0


def test_what_is_wanted_grows_with_the_path() -> None:
    flat = Terrain(0.0, NO_WAVE, []).as_array()
    start, end = np.array([0.0, 0, 0]), np.array([4000.0, 0, 200])
    least, _, shortfall, _ = leg_clearance_m(start, end, 0.0, 4000.0, flat, 100.0, 2000.0)
    assert least == 0.0
    assert abs(shortfall) < 1e-9  # along the ramp exactly, and above it afterwards
    _, _, low, _ = leg_clearance_m(start, end, 0.0, 4000.0, flat, 110.0, 2000.0)
    assert 9.0 < low <= 10.0


def test_a_leg_without_length_on_the_ramp_has_a_clearance() -> None:
    ground = Terrain(0.0, NO_WAVE, [], np.zeros((3, 3)), 0.0, 0.0, 1000.0, 1000.0).as_array()
    there = np.array([500.0, 500.0, 40.0])
    least, _, shortfall, _ = leg_clearance_m(there, there, 1000.0, 1000.0, ground, 100.0, 2000.0)
    assert (least, shortfall) == pytest.approx((40.0, 10.0))
