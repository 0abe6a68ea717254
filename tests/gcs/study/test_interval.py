"""Confidence intervals hold what they promise."""

import math

import numpy as np

from gcs.study.interval import interval


def test_nineteen_of_twenty_intervals_hold_the_mean() -> None:
    rng = np.random.default_rng(2)
    found = [interval(rng.normal(3.0, 2.0, 8).tolist()) for _ in range(1000)]
    held = np.mean([abs(one.mean - 3.0) <= one.half_width for one in found])
    assert 0.93 < held < 0.97


def test_one_value_has_no_interval() -> None:
    assert interval([4.0]).mean == 4.0
    assert math.isnan(interval([4.0]).half_width)
