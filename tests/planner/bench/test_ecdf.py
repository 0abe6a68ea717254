"""Which part of runs and targets is met after how much."""

from collections.abc import Callable

import numpy as np
import pytest

from planner.bench.ecdf import TARGETS, solved_after
from planner.bench.job import Run
from planner.bench.measures import EVALUATIONS


def test_by_hand(make_run: Callable[..., Run]) -> None:
    # One run comes within 100 % to 10 % (11 of 41 targets) after 30 evaluations and meets all after 300; one none.
    runs = [make_run([(30, 0.1, 11.0), (300, 1.0, 10.0)]), make_run([])]
    assert len(TARGETS) == 41
    solved, part = solved_after(runs, {"forest-5-1": 10.0}, EVALUATIONS, {"forest-5-1": 15.0})
    assert solved.tolist() == [2.0] * 11 + [20.0] * 30
    assert part[10] == pytest.approx(11 / 82)
    assert part[-1] == pytest.approx(0.5)
    assert np.all(np.diff(part) > 0.0)


def test_nothing_met(make_run: Callable[..., Run]) -> None:
    solved, part = solved_after([make_run([])], {"forest-5-1": 10.0}, EVALUATIONS, {"forest-5-1": 15.0})
    assert len(solved) == len(part) == 0
