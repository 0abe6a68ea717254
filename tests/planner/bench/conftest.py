"""Runs made by hand."""

from collections.abc import Callable, Sequence

import numpy as np
import pytest

from planner.bench.job import Job, Limit, Run

MakeRun = Callable[..., Run]
LIMIT = Limit(100)


@pytest.fixture
def make_run() -> MakeRun:
    """A run from lines of evaluations, seconds and cost; a thousand evaluations and ten seconds unless told."""

    def make(
        lines: Sequence[tuple[int, float, float]],
        *,
        problem: str = "forest-5-1",
        method: str = "pso",
        seed: int = 1,
        limit: Limit = LIMIT,
        evaluations: int = 1000,
        cpu_s: float = 10.0,
    ) -> Run:
        job = Job(problem, "", method, seed, limit)
        return Run(job, evaluations, cpu_s, np.array(lines, dtype=np.float64).reshape(-1, 3), None)

    return make
