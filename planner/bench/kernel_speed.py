"""How fast the compiled objective is: beside plain numpy, with one thread and all, over peaks and over a raster, and
beside what the processor could do at most."""

import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numba
import numpy as np
import numpy.typing as npt

from missions.environment import Terrain, ground_heights_m
from missions.environment.terrain import NO_WAVE
from planner.bench.count_work import KINDS, work_of
from planner.bench.numpy_objective import evaluate_in_numpy
from planner.bench.peaks import peak_rates
from planner.bench.problems import bench_problem
from planner.cost.kernel import evaluate
from planner.cost.problem import PathProblem
from planner.search.waves import wave_view

FloatArray = npt.NDArray[np.float64]

PROBLEMS = ("radars-leader", "mountains-leader")
RASTER_OF, POSTS_M = "mountains-leader", 100.0
"""Whose ground is also measured as a raster, and its spacing."""
SPREAD = 0.2
"""Largest number of the random paths that are evaluated, of 1: sensible ones, as in the middle of a search."""
PATHS, NUMPY_PATHS, COUNTED_PATHS = 2000, 200, 20
REPEATS = 7


@dataclass(frozen=True)
class KernelSpeed:
    """Figures of one problem.

    Attributes:
        problem, ground: which, over "peaks", "level" or "raster".
        one_thread, all_threads, in_numpy: evaluations a second; numpy's with as many threads as it takes.
        threads: of all.
        work: operations an evaluation by kind.
        least_s: the time that these take at the measured peak rates of one core.
        share_of_peak: least_s over the time that one evaluation takes with one thread.
    """

    problem: str
    ground: str
    one_thread: float
    all_threads: float
    in_numpy: float
    threads: int
    work: dict[str, float]
    least_s: float
    share_of_peak: float


def kernel_speeds() -> tuple[dict[str, float], list[KernelSpeed]]:
    """Peak rates, operations a second by kind on one core, and the figures of each problem."""
    peaks = peak_rates()
    measured = []
    for name in PROBLEMS:
        problem = bench_problem(name).problem
        measured.append(_measured(name, "peaks" if len(problem.terrain.peaks) else "level", problem, peaks))
    return peaks, [*measured, _measured(RASTER_OF, "raster", on_raster(bench_problem(RASTER_OF).problem), peaks)]


def on_raster(problem: PathProblem) -> PathProblem:
    """The same problem over a raster of its ground."""
    bounds = problem.bounds
    x = np.arange(bounds.x_min_m, bounds.x_max_m + POSTS_M, POSTS_M)
    y = np.arange(bounds.y_min_m, bounds.y_max_m + POSTS_M, POSTS_M)
    posts = ground_heights_m(x, y[:, None], problem.terrain)
    raster = Terrain(0.0, NO_WAVE, (), posts, bounds.x_min_m, bounds.y_min_m, POSTS_M, POSTS_M)
    return problem._replace(terrain=raster.as_array())


def _measured(name: str, ground: str, problem: PathProblem, peaks: dict[str, float]) -> KernelSpeed:
    named = bench_problem(name)
    numbers = np.random.default_rng(0).uniform(-SPREAD, SPREAD, (PATHS, named.dimension))
    paths = wave_view(problem, named.waypoints).interiors(numbers)
    threads = numba.get_num_threads()
    all_threads = PATHS / least_s(lambda: evaluate(paths, problem, "graded"), time.perf_counter)
    numba.set_num_threads(1)
    try:
        one = PATHS / least_s(lambda: evaluate(paths, problem, "graded"), time.process_time)
    finally:
        numba.set_num_threads(threads)
    some = paths[:NUMPY_PATHS]
    in_numpy = NUMPY_PATHS / least_s(lambda: evaluate_in_numpy(some, problem), time.perf_counter)
    work = dict.fromkeys(KINDS, 0.0)
    for path in paths[:COUNTED_PATHS]:
        for kind, count in work_of(problem.corners_m(path), problem)[1].items():
            work[kind] += count / COUNTED_PATHS
    least = sum(count / peaks[kind] for kind, count in work.items())
    return KernelSpeed(name, ground, one, all_threads, in_numpy, threads, work, least, least * one)


def least_s(call: Callable[[], Any], clock: Callable[[], float]) -> float:
    """The shortest time of several calls after a first one: the others were disturbed."""
    call()
    times = []
    for _ in range(REPEATS):
        start = clock()
        call()
        times.append(clock() - start)
    return min(times)
