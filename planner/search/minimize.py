"""The searches as a general tool, called as scipy's minimisers are."""

import difflib

import numpy as np
import numpy.typing as npt
from scipy.optimize import Bounds, OptimizeResult

from missions.errors import InputError
from planner.search.methods import METHODS
from planner.search.objective import BudgetSpent, Callback, FloatArray, Fun, Objective, Stopped

BUDGET_SPENT, ENDED, STOPPED = 0, 1, 99
"""Values of `status`; the last is scipy's for a callback that raised StopIteration."""
MESSAGES = {
    BUDGET_SPENT: "the budget of evaluations is used",
    ENDED: "the method ended by itself",
    STOPPED: "`callback` raised `StopIteration`",
}


def minimize(
    fun: Fun,
    bounds: npt.ArrayLike | Bounds,
    *,
    method: str = "skein",
    budget: int,
    seed: int | np.random.SeedSequence | np.random.Generator,
    x0: npt.ArrayLike | None = None,
    callback: Callback | None = None,
) -> OptimizeResult:
    """Search for the least value of a function in a box.

    Args:
        fun: (n, d) points to (n,) costs; NaN counts as infinite.
        bounds: (d, 2) lowest and highest value of each number, or scipy's `Bounds`.
        method: a key of `planner.search.methods.METHODS`.
        budget: evaluations at most; never exceeded.
        seed: all there is of chance; the same seed gives the same result.
        x0: (d,) or (n, d) points to begin with; they are among the first that are evaluated.
        callback: called after each batch with `intermediate_result`, an `OptimizeResult` with x, fun, nfev and nit;
            may raise StopIteration to end the search.

    Returns:
        `OptimizeResult` with `x` (d,) and `fun`, the best point that was evaluated; `nfev` evaluations in `nit`
        batches; `history` (nit, 2), evaluations and best cost after each batch; `status` and `message`, why it ended;
        `success`, whether a finite cost was found.

    Raises:
        InputError: an argument is wrong, or the method needs the extra `skein-gcs[bench]` and it is not installed.
    """
    if method not in METHODS:
        near = difflib.get_close_matches(method, METHODS, n=1)
        raise InputError(
            f"method {method}: must be one of {', '.join(METHODS)}{f'; did you mean {near[0]}?' if near else ''}"
        )
    if not isinstance(budget, int | np.integer) or budget < 1:
        raise InputError(f"budget {budget!r}: must be a whole number of evaluations, 1 or more")
    try:
        rng = np.random.default_rng(seed)
    except (TypeError, ValueError) as error:
        raise InputError(f"seed {seed!r}: {error}") from None
    low, high = _box(bounds)
    starts = _starts(x0, low, high)
    objective = Objective(fun, low, high, int(budget), callback)
    status = ENDED
    try:
        METHODS[method](objective, starts, rng)
    except BudgetSpent:
        status = BUDGET_SPENT
    except Stopped:
        status = STOPPED
    return OptimizeResult(  # type: ignore[call-arg]  # the stubs know no keywords
        x=objective.best,
        fun=objective.cost,
        nfev=objective.spent,
        nit=len(objective.history),
        history=np.array(objective.history, dtype=np.float64).reshape(-1, 2),
        success=bool(np.isfinite(objective.cost)),
        status=status,
        message=MESSAGES[status],
    )


def _box(bounds: npt.ArrayLike | Bounds) -> tuple[FloatArray, FloatArray]:
    """(d,) low and high."""
    pairs = np.column_stack([bounds.lb, bounds.ub]) if isinstance(bounds, Bounds) else bounds
    box = np.array(pairs, dtype=np.float64)
    if box.ndim != 2 or box.shape[1] != 2 or len(box) == 0:
        raise InputError(f"bounds: must have shape (d, 2), a lowest and a highest value each, got {box.shape}")
    for i, (low, high) in enumerate(box):
        if not (np.isfinite(low) and np.isfinite(high)):
            raise InputError(f"bounds[{i}]: must be finite, got {low} to {high}")
        if low >= high:
            raise InputError(f"bounds[{i}]: the lowest value must be below the highest, got {low} to {high}")
    return box[:, 0], box[:, 1]


def _starts(x0: npt.ArrayLike | None, low: FloatArray, high: FloatArray) -> FloatArray:
    """(n, d)."""
    if x0 is None:
        return np.empty((0, len(low)))
    starts = np.atleast_2d(np.array(x0, dtype=np.float64))
    if starts.ndim != 2 or starts.shape[1] != len(low):
        raise InputError(f"x0: must have shape ({len(low)},) or (n, {len(low)}), got {np.shape(x0)}")
    outside = ~((starts >= low) & (starts <= high))  # NaN, too, is outside
    if outside.any():
        row, number = np.argwhere(outside)[0]
        raise InputError(
            f"x0[{row}][{number}]: must be within the bounds {low[number]} to {high[number]}, got {starts[row, number]}"
        )
    return starts
