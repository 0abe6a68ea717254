"""Empirical distributions of running times, as COCO draws them: which part of all (run, target) pairs is solved after
how much."""

from collections.abc import Iterable, Mapping

import numpy as np
import numpy.typing as npt

from planner.bench.job import Run
from planner.bench.measures import used_to_reach

FloatArray = npt.NDArray[np.float64]

TARGETS = np.logspace(0.0, -4.0, 41)
"""Gaps to the best-known value: 100 % to 0.01 %, ten a decade."""


def solved_after(
    runs: Iterable[Run], best_km: Mapping[str, float], column: int, scale: Mapping[str, float]
) -> tuple[FloatArray, FloatArray]:
    """What had been used when each further pair was solved, ascending, and the part of all pairs solved by then.

    Args:
        runs: of one method.
        best_km: best-known value by problem.
        column: of `Run.lines`, what is counted.
        scale: by problem, what it is divided by, such as the dimension.

    Runs are taken as they are; COCO also strings unsuccessful ones together to simulate restarts.
    """
    hits = np.concatenate(
        [used_to_reach(run, best_km[run.job.problem], column, TARGETS) / scale[run.job.problem] for run in runs]
    )
    solved = np.sort(hits[np.isfinite(hits)])
    return solved, np.arange(1, len(solved) + 1) / len(hits)
