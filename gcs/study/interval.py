"""Means over seeds, and how well they are known."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.stats import t as student_t

CONFIDENCE = 0.95


@dataclass(frozen=True)
class Interval:
    """A mean and the half width of its 95 % confidence interval, by Student's t; NaN for a single value."""

    mean: float
    half_width: float


def interval(values: Sequence[float]) -> Interval:
    """Of some values, at least one."""
    found = np.asarray(values, dtype=np.float64)
    if len(found) < 2:
        return Interval(float(found[0]), math.nan)
    quantile = float(student_t.ppf(0.5 + CONFIDENCE / 2.0, len(found) - 1))
    return Interval(float(found.mean()), quantile * float(found.std(ddof=1)) / math.sqrt(len(found)))
