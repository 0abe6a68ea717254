"""Bounds hold, and are as near to the truth as they promise."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from planner.proof.bracket import RESOLUTION_M, Intervals, between, both, even, least


def sines(seed: int, rows: int, known_bend: bool):  # type: ignore[no-untyped-def]
    """Functions a sin(w u + p) + b u, with bounds of their slopes and, if wanted, of their bends."""
    a, w, p, b = np.random.default_rng(seed).uniform([[0], [0.1], [0], [-1]], [[5], [4], [6], [1]], (4, rows))

    def value(row, u):  # type: ignore[no-untyped-def]
        return a[row] * np.sin(w[row] * u + p[row]) + b[row] * u

    def bounds(row, start, end):  # type: ignore[no-untyped-def]
        at_start, at_end = value(row, start), value(row, end)
        bend = a[row] * w[row] ** 2 if known_bend else np.full(len(row), np.inf)
        lower = between(at_start, at_end, end - start, a[row] * w[row] + abs(b[row]), bend)
        return lower, np.minimum(at_start, at_end), np.where(at_start <= at_end, start, end)

    return value, bounds


@settings(max_examples=30, deadline=None)
@given(seed=st.integers(0, 2**32), rows=st.integers(1, 5), width=st.floats(0.5, 20.0), known_bend=st.booleans())
def test_the_least_value_lies_within_its_bracket(seed: int, rows: int, width: float, known_bend: bool) -> None:
    value, bounds = sines(seed, rows, known_bend)
    found = least(rows, even(np.zeros(rows), np.full(rows, 9.0), width), bounds, np.inf)
    u = np.linspace(0.0, 9.0, 20001)
    for row in range(rows):
        truth = value(np.full(len(u), row), u).min()
        assert found.low[row] <= truth + 1e-12
        assert found.low[row] >= truth - RESOLUTION_M - 1e-4
        assert found.value[row] == pytest.approx(value(row, found.at[row]), abs=1e-12)


def test_what_is_enough_is_not_looked_into_any_further() -> None:
    value, bounds = sines(3, 4, True)
    calls = []

    def counted(row, a, b):  # type: ignore[no-untyped-def]
        calls.append(len(row))
        return bounds(row, a, b)

    found = least(4, even(np.zeros(4), np.full(4, 9.0), 1.0), counted, -1000.0)
    assert calls == [36]
    u = np.linspace(0.0, 9.0, 2001)
    assert all(found.low[row] <= value(np.full(len(u), row), u).min() for row in range(4))


def test_where_no_bound_helps_the_ends_of_ever_shorter_intervals_decide() -> None:
    def bounds(row, a, b):  # type: ignore[no-untyped-def]
        inside = (a <= 0.3) & (b >= 0.3)
        return np.where(inside, -np.inf, 5.0), np.full(len(row), 5.0), a

    found = least(1, even(np.zeros(1), np.ones(1), 1.0), bounds, np.inf)
    assert (found.low[0], found.value[0]) == (5.0, 5.0)


@settings(max_examples=30, deadline=None)
@given(
    ends=st.lists(st.tuples(st.floats(0, 100), st.floats(-1, 100)), min_size=1, max_size=5), width=st.floats(0.3, 50)
)
def test_even_intervals_cover_each_row_without_a_gap(ends: list[tuple[float, float]], width: float) -> None:
    start = np.array([a for a, _ in ends])
    end = start + np.array([length for _, length in ends])
    cut = even(start, end, width)
    for row in range(len(ends)):
        mine = cut.row == row
        if end[row] <= start[row]:
            assert not mine.any()
            continue
        assert cut.start[mine][0] == start[row]
        assert cut.end[mine][-1] == end[row]
        assert cut.start[mine][1:] == pytest.approx(cut.end[mine][:-1], abs=1e-12)
        assert np.all(cut.end[mine] - cut.start[mine] <= width + 1e-9)


def test_both_keeps_all_intervals() -> None:
    one, two = even(np.zeros(1), np.ones(1), 0.5), Intervals(np.array([1]), np.array([2.0]), np.array([3.0]))
    together = both(one, two)
    assert together.row.tolist() == [0, 0, 1]
    assert together.end.tolist() == [0.5, 1.0, 3.0]
