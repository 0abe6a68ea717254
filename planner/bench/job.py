"""One run of one method on one problem: small to send, the same wherever it runs."""

import itertools
import time
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass

import numba
import numpy as np
import numpy.typing as npt

from planner.bench.methods import METHODS, Method
from planner.bench.problems import BenchProblem, bench_problem
from planner.bench.trace import Stop, Tracer

FloatArray = npt.NDArray[np.float64]

WARM_UP = 400
"""Evaluations of a first search whose time does not count."""
PILOT = 40
"""Evaluations a number of the run that measures how many a method will manage in its time."""
RESTART_ABOVE = 0.05
"""A search that ends with more than this part of its limit left begins again with other chance."""


@dataclass(frozen=True)
class Limit:
    """What ends a run: evaluations a dimension, or CPU seconds. One of them is 0."""

    evaluations_per_dimension: int = 0
    cpu_s: float = 0.0

    @property
    def label(self) -> str:
        """For tables."""
        return f"{self.evaluations_per_dimension}/d" if self.evaluations_per_dimension else f"{self.cpu_s:g} s"


@dataclass(frozen=True)
class Job:
    """One run.

    Attributes:
        problem, digest: name and content; a worker whose problem of that name differs refuses.
        method: a key of `METHODS`.
        seed: all there is of chance.
        limit: of the run.
    """

    problem: str
    digest: str
    method: str
    seed: int
    limit: Limit

    @property
    def name(self) -> str:
        """For people."""
        return f"{self.problem} {self.method} seed {self.seed} {self.limit.label}"


@dataclass(frozen=True)
class Run:
    """What came of a job.

    Attributes:
        job: which.
        evaluations, cpu_s: used in all.
        lines: (n, 3) evaluations, CPU seconds and best feasible cost in kilometres after each improvement; none
            when nothing feasible was found.
        path_m: interior waypoints of the best path, flat; None when unknown.
    """

    job: Job
    evaluations: int
    cpu_s: float
    lines: FloatArray
    path_m: FloatArray | None


def run_job(job: Job) -> Run:
    """Run a job in this process, with one thread.

    Raises:
        RuntimeError: this process's problem of that name is another one.
    """
    problem = bench_problem(job.problem)
    if problem.digest != job.digest:
        raise RuntimeError(f"{job.problem} is {problem.digest} here, not {job.digest}: another version of skein?")
    numba.set_num_threads(1)
    method = METHODS[job.method]
    _searched(method, problem, WARM_UP, Tracer(WARM_UP, None))  # what must be compiled or imported now is
    if job.limit.cpu_s:
        budget = _budget_in(job.limit.cpu_s, problem, method)
        tracer = Tracer(None, job.limit.cpu_s)
    else:
        budget = job.limit.evaluations_per_dimension * problem.dimension
        tracer = Tracer(budget, None)
    for seed in _seeds(job.seed):
        tracer.restarted()
        try:
            method(problem, max(1, round(budget * tracer.remaining)), seed, tracer)
        except Stop:
            break
        if tracer.remaining < RESTART_ABOVE:
            break
    tracer.finish()
    return Run(job, tracer.evaluations, tracer.cpu_s, np.array(tracer.lines).reshape(-1, 3), tracer.path_m)


def _seeds(seed: int) -> Iterator[int]:
    """The seed itself, then those of restarts, without end."""
    yield seed
    for restart in itertools.count(1):
        yield int(np.random.SeedSequence([seed, restart]).generate_state(1)[0])


def _budget_in(cpu_s: float, problem: BenchProblem, method: Method) -> int:
    """Evaluations that a method will manage in a time: schedules that depend on the budget must end with it."""
    evaluations = PILOT * problem.dimension
    tracer = Tracer(evaluations, None)
    start = time.process_time()
    _searched(method, problem, evaluations, tracer)
    took_s = max(time.process_time() - start, 1e-4)
    return max(evaluations, round(tracer.evaluations * cpu_s / took_s))


def _searched(method: Method, problem: BenchProblem, evaluations: int, tracer: Tracer) -> None:
    """A search that does not count."""
    with suppress(Stop):
        method(problem, evaluations, 0, tracer)
