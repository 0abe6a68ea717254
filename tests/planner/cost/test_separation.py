"""Distances in time against dense samples."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from planner.cost.separation import least_separation_m


@settings(max_examples=60, deadline=None)
@given(seed=st.integers(0, 2**32))
def test_least_separation_is_that_of_dense_samples(seed: int) -> None:
    rng = np.random.default_rng(seed)

    def path(corners: int) -> np.ndarray:
        progress = np.sort(np.append(rng.random(corners - 2), [0.0, 1.0]))
        return np.column_stack([rng.uniform(-1000, 1000, (corners, 3)), progress])

    own, other = path(int(rng.integers(2, 7))), path(int(rng.integers(2, 7)))
    leg = 0
    for k in range(len(own) - 1):
        start, end = own[k, 3], own[k + 1, 3]
        found, _, leg = least_separation_m(own[k, :3], own[k + 1, :3], start, end, other, leg)
        bends = [start, *(u for u in other[:, 3] if start < u < end), end]
        u = np.concatenate([np.linspace(*pair, 2001) for pair in pairwise(bends)])
        here, there = (np.stack([np.interp(u, p[:, 3], p[:, axis]) for axis in range(3)], axis=1) for p in (own, other))
        assert found == pytest.approx(np.linalg.norm(here - there, axis=1).min(), abs=2.0)


def test_the_same_place_at_another_time_is_no_meeting() -> None:
    north = np.array([[0.0, -1000, 0, 0], [0, 1000, 0, 1]])
    west, east = np.array([-1000.0, 0, 0]), np.array([1000.0, 0, 0])
    meeting, _, _ = least_separation_m(west, east, 0.0, 1.0, north, 0)
    assert meeting == pytest.approx(0.0, abs=1e-9)
    late = np.array([[0.0, -1000, 0, 0], [0, -900, 0, 0.5], [0, 1000, 0, 1]])
    apart, _, leg = least_separation_m(west, east, 0.0, 1.0, late, 0)
    assert apart == pytest.approx(900 * 2000 / np.hypot(2000, 3800))
    assert leg == 1
