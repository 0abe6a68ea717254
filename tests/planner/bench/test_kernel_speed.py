"""Measuring the kernel: what is counted and what is compared; how fast it is, is for the command to say."""

import numpy as np
import pytest

from missions.environment import ground_heights_m
from planner.bench import kernel_speed, peaks
from planner.bench.count_work import KINDS, Counted, work_of
from planner.bench.problems import bench_problem


@pytest.mark.parametrize("name", ["radars-leader", "mountains-F3", "canyons-5-1"])
def test_the_counting_kernel_finds_the_same_cost(name: str) -> None:
    problem = bench_problem(name)
    line = np.linspace(problem.problem.origin_m, problem.problem.target_m, problem.waypoints + 2)
    line[2, :2] += [50.0, 700.0]
    cost, counts = work_of(line, problem.problem)
    expected = kernel_speed.evaluate(line[1:-1].reshape(1, -1), problem.problem, "graded")[0][0]
    assert cost == pytest.approx(expected, rel=1e-12)
    assert set(counts) <= set(KINDS)
    assert counts["flops"] > 100 * len(line)
    assert (counts["exp"] > 0) == (name == "mountains-F3")


def test_operations_are_counted_by_hand() -> None:
    from collections import Counter

    counts: Counter[str] = Counter()
    x = Counted(3.0, counts)
    y = (2.0 * x + x / 4.0 - 1.0) * -abs(x)
    assert float(y) == -17.25
    assert counts == {"flops": 5}
    assert x > 2 and x <= 3.0  # noqa: PT018
    assert counts == {"flops": 5}


def test_a_raster_of_the_mountains_is_the_mountains() -> None:
    problem = bench_problem("mountains-leader").problem
    x, y = np.meshgrid(np.arange(500.0, 40000.0, 1000.0), np.arange(500.0, 32000.0, 1000.0))
    raster = kernel_speed.on_raster(problem).terrain
    assert ground_heights_m(x, y, raster) == pytest.approx(ground_heights_m(x, y, problem.terrain), abs=1e-6)


def test_every_figure_is_there(monkeypatch: pytest.MonkeyPatch) -> None:
    for name, value in (("PATHS", 20), ("NUMPY_PATHS", 5), ("COUNTED_PATHS", 1), ("REPEATS", 1)):
        monkeypatch.setattr(kernel_speed, name, value)
    monkeypatch.setattr(peaks, "REPEATS", 1)
    rates, speeds = kernel_speed.kernel_speeds()
    assert set(rates) == set(KINDS)
    assert [(speed.problem, speed.ground) for speed in speeds] == [
        ("radars-leader", "level"),
        ("mountains-leader", "peaks"),
        ("mountains-leader", "raster"),
    ]
    for speed in speeds:
        assert speed.share_of_peak == pytest.approx(speed.least_s * speed.one_thread)
        assert speed.least_s == pytest.approx(sum(speed.work[kind] / rates[kind] for kind in KINDS))
