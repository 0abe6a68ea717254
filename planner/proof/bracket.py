"""The least value of many functions at once, between bounds: intervals are halved until nothing can hide in them."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.float64]
IntArray = npt.NDArray[np.int64]
Bounds = Callable[[IntArray, FloatArray, FloatArray], tuple[FloatArray, FloatArray, FloatArray]]
"""Of a function (the first argument says which) on intervals [a, b]: a value that it does not go below there, one that
it reaches, and where it reaches that."""

RESOLUTION_M = 0.02
"""Between the proven bound of a least value and the value itself, at most."""
NARROW = 1e-6
"""Intervals this short, in metres or seconds, are not halved: their ends stand for them. Only where a path has a
sharp corner, at which no bound helps, does it come to that."""


@dataclass(frozen=True)
class Least:
    """Of each function, (rows,): `low` is proven, `value` is reached, at `at`; infinite where there is no interval.

    `value - low` is at most the resolution, unless `low` is already enough.
    """

    low: FloatArray
    value: FloatArray
    at: FloatArray


@dataclass(frozen=True)
class Intervals:
    """Where functions are looked at: which one, (n,), from and to, (n,)."""

    row: IntArray
    start: FloatArray
    end: FloatArray


def even(start: FloatArray, end: FloatArray, width: float) -> Intervals:
    """[start, end] of each row, (rows,), cut into equal intervals at most `width` wide; empty rows are left out."""
    count = np.where(end > start, np.ceil((end - start) / width), 0).astype(np.int64)
    row = np.repeat(np.arange(len(start)), count)
    k = np.arange(len(row)) - np.repeat(np.cumsum(count) - count, count)
    step = (end - start)[row] / count[row]
    return Intervals(row, start[row] + k * step, np.where(k + 1 == count[row], end[row], start[row] + (k + 1) * step))


def both(first: Intervals, second: Intervals) -> Intervals:
    """The intervals of two sets."""
    return Intervals(
        np.concatenate([first.row, second.row]),
        np.concatenate([first.start, second.start]),
        np.concatenate([first.end, second.end]),
    )


def least(rows: int, intervals: Intervals, bounds: Bounds, enough: FloatArray | float) -> Least:
    """Bracket the least value of each function.

    Args:
        rows: how many functions there are.
        intervals: what to cover; a row's may be any.
        bounds: of the functions.
        enough: (rows,) or one for all; a bound this high need not be improved.
    """
    enough = np.broadcast_to(np.asarray(enough, dtype=np.float64), rows)
    low, value, at = np.full(rows, np.inf), np.full(rows, np.inf), np.zeros(rows)
    row, a, b = intervals.row, intervals.start, intervals.end
    while len(row):
        lower, reached, where = bounds(row, a, b)
        lower = np.where(b - a < NARROW, reached, lower)
        best = np.lexsort((reached, row))
        first = best[np.concatenate([[True], np.diff(row[best]) > 0])]
        better = first[reached[first] < value[row[first]]]
        value[row[better]], at[row[better]] = reached[better], where[better]
        done = lower >= np.minimum(value[row] - RESOLUTION_M, enough[row])
        np.minimum.at(low, row[done], lower[done])
        row, a, b = row[~done], a[~done], b[~done]
        middle = (a + b) / 2
        row, a, b = np.concatenate([row, row]), np.concatenate([a, middle]), np.concatenate([middle, b])
    return Least(low, value, at)


def between(start: FloatArray, end: FloatArray, width: FloatArray, slope: FloatArray, bend: FloatArray) -> FloatArray:
    """What a function, or the least of several, does not go below between two values `width` apart.

    A function whose slope is at most L stays above the cones from both ends, (f0 + f1) / 2 - L h / 2; one whose
    second derivative is at most M dips by at most M h^2 / 8 below its chord. The better of the two holds.
    """
    by_slope = (start + end - slope * width) / 2
    by_bend = np.minimum(start, end) - bend * width**2 / 8
    return np.maximum(by_slope, by_bend)
