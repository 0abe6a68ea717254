"""The moving average of a piecewise linear function: against numerical integration, and what it keeps."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from missions.reference.smoothing import moving_average, quadratic_at, quadratics_at

steps = st.lists(st.tuples(st.floats(0.5, 50), st.floats(-100, 100)), min_size=1, max_size=6)


def knots_of(pieces: list[tuple[float, float]]) -> tuple[np.ndarray, np.ndarray]:
    knots = np.concatenate([[0.0], np.cumsum([length for length, _ in pieces])])
    return knots, np.concatenate([[0.0], np.cumsum([rise for _, rise in pieces])])


def extended(u: np.ndarray, knots: np.ndarray, values: np.ndarray) -> np.ndarray:
    first, last = (np.diff(values) / np.diff(knots))[[0, -1]]
    inner = np.interp(u, knots, values)
    return inner + np.minimum(u - knots[0], 0) * first + np.maximum(u - knots[-1], 0) * last


@given(steps, st.floats(0.5, 20), st.floats(0, 1))
def test_it_is_the_mean_over_the_window(pieces: list[tuple[float, float]], window: float, share: float) -> None:
    knots, values = knots_of(pieces)
    u = share * knots[-1]
    around = u + window * (np.arange(20_000) + 0.5) / 20_000 - window / 2
    mean = extended(around, knots, values).mean()
    smoothed, _ = quadratics_at(np.array([u]), moving_average(knots, values, window))
    assert smoothed[0] == pytest.approx(mean, abs=1e-3)


@given(steps, st.floats(0.5, 20))
def test_value_and_slope_are_continuous(pieces: list[tuple[float, float]], window: float) -> None:
    table = moving_average(*knots_of(pieces), window)
    for row in range(1, len(table)):
        before = quadratic_at(np.nextafter(table[row, 0], -np.inf), row - 1, table)
        at = quadratic_at(table[row, 0], row, table)
        assert before[:2] == pytest.approx(at[:2], abs=1e-6)


@given(st.floats(-5, 5), st.floats(1, 100), st.floats(0.5, 50))
def test_a_line_is_its_own_average(slope: float, length: float, window: float) -> None:
    table = moving_average(np.array([0.0, length]), np.array([3.0, 3.0 + slope * length]), window)
    assert quadratic_at(0.0, 0, table)[:2] == pytest.approx((3.0, slope), abs=1e-9)
    assert quadratic_at(length, 0, table)[0] == pytest.approx(3.0 + slope * length, abs=1e-6)


@given(steps, st.floats(0.5, 20), st.floats(-10, 60))
def test_one_value_at_a_time_is_the_same(pieces: list[tuple[float, float]], window: float, u: float) -> None:
    table = moving_average(*knots_of(pieces), window)
    value, slope = quadratics_at(np.array([u]), table)
    assert quadratic_at(u, len(table) - 1, table.tolist())[:2] == pytest.approx((value[0], slope[0]), abs=1e-9)
