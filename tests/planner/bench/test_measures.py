"""Gaps and running times against cases worked by hand."""

import math
from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from planner.bench.job import Run
from planner.bench.measures import (
    CPU_S,
    EVALUATIONS,
    expected_running_time,
    final_gap,
    gaps_at,
    quartiles,
    used_to_reach,
)

LINES = [(10, 0.1, 12.0), (50, 0.5, 11.0), (200, 2.0, 10.05)]


def test_a_run_reaches_each_target_once(make_run: Callable[..., Run]) -> None:
    targets = np.array([0.25, 0.2, 0.1, 0.01, 0.001])
    assert used_to_reach(make_run(LINES), 10.0, EVALUATIONS, targets).tolist() == [10, 10, 50, 200, math.inf]
    assert used_to_reach(make_run(LINES), 10.0, CPU_S, targets).tolist() == [0.1, 0.1, 0.5, 2.0, math.inf]


def test_gaps_on_the_way(make_run: Callable[..., Run]) -> None:
    used = np.array([9.0, 10.0, 49.0, 50.0, 1e6])
    assert gaps_at(make_run(LINES), 10.0, EVALUATIONS, used) == pytest.approx([math.inf, 0.2, 0.2, 0.1, 0.005])
    assert final_gap(make_run(LINES), 10.0) == pytest.approx(0.005)


def test_a_run_that_found_nothing(make_run: Callable[..., Run]) -> None:
    nothing = make_run([])
    assert final_gap(nothing, 10.0) == math.inf
    assert used_to_reach(nothing, 10.0, EVALUATIONS, np.array([1.0])).tolist() == [math.inf]
    assert gaps_at(nothing, 10.0, EVALUATIONS, np.array([1.0])).tolist() == [math.inf]


def test_expected_running_time_is_that_of_coco() -> None:
    # Two of three succeed after 100 and 300; the third used 1000 in vain: (100 + 300 + 1000) / 2.
    assert expected_running_time([100.0, 300.0, math.inf], [1000, 1000, 1000]) == 700.0
    assert expected_running_time([math.inf], [1000]) == math.inf


@given(st.lists(st.floats(0.0, 1e6), min_size=1, max_size=20))
def test_without_failures_it_is_the_mean(reached: list[float]) -> None:
    assert expected_running_time(reached, [1e9] * len(reached)) == pytest.approx(np.mean(reached))


def test_quartiles_may_be_infinite() -> None:
    assert quartiles([1.0, 2.0, 3.0, math.inf]) == (1.0, 2.0, 3.0)
    assert quartiles([1.0, math.inf, math.inf, math.inf]) == (1.0, math.inf, math.inf)
