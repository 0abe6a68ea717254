"""What a tracer keeps of a search, and when it ends it."""

import numpy as np
import pytest

from planner.bench.trace import Stop, Tracer
from planner.cost.kernel import INFEASIBLE_KM
from planner.search.waves import WaveView


class Clock:
    def __init__(self) -> None:
        self.now = 5.0

    def __call__(self) -> float:
        return self.now


def test_improvements_only_and_no_infeasible_ones() -> None:
    clock = Clock()
    tracer = Tracer(100, None, clock)
    for evaluations, cost in ((1, INFEASIBLE_KM + 7), (5, 50.0), (9, 60.0), (20, 49.9999), (30, 40.0), (40, 39.9999)):
        clock.now += 1.0
        tracer.report(evaluations, cost)
    assert tracer.lines == [(5, 2.0, 50.0), (30, 5.0, 40.0)]
    tracer.finish()
    assert tracer.lines[-1] == (40, 6.0, 39.9999)


def test_ends_a_search_that_goes_beyond_its_evaluations_and_forgets_what_came_too_late() -> None:
    tracer = Tracer(100, None, Clock())
    tracer.report(100, 50.0)
    with pytest.raises(Stop):
        tracer.report(101, 40.0)
    assert (tracer.evaluations, tracer.lines) == (100, [(100, 0.0, 50.0)])
    assert tracer.remaining == 0.0


def test_ends_a_search_that_goes_beyond_its_time() -> None:
    clock = Clock()
    tracer = Tracer(None, 2.0, clock)
    clock.now += 1.5
    tracer.report(10, 50.0)
    assert tracer.remaining == pytest.approx(0.25)
    clock.now += 1.0
    with pytest.raises(Stop):
        tracer.report(20, 40.0)
    assert tracer.lines == [(10, 1.5, 50.0)]


def test_a_black_box_is_counted_and_its_best_path_kept() -> None:
    view = WaveView(lambda x: x[:, 0], np.array([[0.0, 1.0]]), lambda x: 100.0 * x, lambda x: x / 100.0)
    tracer = Tracer(10, None, Clock())
    fun = tracer.counted(view)
    assert fun(np.array([[3.0], [2.0]])).tolist() == [3.0, 2.0]
    fun(np.array([[4.0]]))
    assert tracer.evaluations == 3
    assert tracer.path_m is not None
    assert tracer.path_m.tolist() == [200.0]


def test_a_restart_counts_on() -> None:
    tracer = Tracer(100, None, Clock())
    tracer.report(40, 50.0)
    tracer.restarted()
    tracer.report(10, 45.0)
    assert tracer.evaluations == 50
