"""What runs are judged by: the gap to the best-known value, and what it takes to come within a target of it."""

from collections.abc import Iterable, Sequence

import numpy as np
import numpy.typing as npt

from planner.bench.job import Run

FloatArray = npt.NDArray[np.float64]

EVALUATIONS, CPU_S = 0, 1
"""Columns of `Run.lines` that count what a run has used."""


def gap(cost_km: float, best_km: float) -> float:
    """How much more than the best-known value, relative; infinite without a feasible path."""
    return max(0.0, cost_km / best_km - 1.0)


def final_gap(run: Run, best_km: float) -> float:
    """Gap of a run's best path."""
    return gap(float(run.lines[-1, 2]), best_km) if len(run.lines) else np.inf


def gaps_at(run: Run, best_km: float, column: int, used: FloatArray) -> FloatArray:
    """Gaps that a run had reached when it had used so much, (n,), ascending, of `column`."""
    reached = np.concatenate([[np.inf], run.lines[:, 2]])
    gaps: FloatArray = np.maximum(
        0.0, reached[np.searchsorted(run.lines[:, column], used, side="right")] / best_km - 1.0
    )
    return gaps


def used_to_reach(run: Run, best_km: float, column: int, targets: FloatArray) -> FloatArray:
    """What a run had used, (n,), when its gap was first no larger than each target; infinite where it never was."""
    used = np.concatenate([run.lines[:, column], [np.inf]])
    # Costs fall from line to line: count those still above a target.
    above = np.sum(run.lines[:, 2, None] > best_km * (1.0 + targets), axis=0)
    reached: FloatArray = used[above]
    return reached


def expected_running_time(reached: Sequence[float], spent: Sequence[float]) -> float:
    """ERT as COCO defines it: what all runs used until they reached the target or ended, over how many reached it.

    Args:
        reached: what each run had used when it reached the target; infinite where it did not.
        spent: what it used in all.

    Infinite when none reached it.
    """
    successes = np.isfinite(reached)
    if not successes.any():
        return np.inf
    return float(np.where(successes, reached, spent).sum() / successes.sum())


def quartiles(values: Iterable[float]) -> tuple[float, float, float]:
    """First quartile, median, third quartile, each one of the values: some may be infinite."""
    first, middle, third = np.quantile(list(values), [0.25, 0.5, 0.75], method="inverted_cdf")
    return float(first), float(middle), float(third)
