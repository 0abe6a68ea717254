"""Ranks and tests against cases worked by hand."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from planner.bench.significance import friedman_p, holm, mean_ranks, wilcoxon_p

ALWAYS_IN_ORDER = np.array([[0.1, 0.2, 0.3], [0.01, 0.2, 0.9], [0.0, 0.001, 0.002], [0.5, 0.6, math.inf]])


def test_mean_ranks_share_ties_and_put_the_infeasible_last() -> None:
    gaps = np.array([[0.1, 0.2, math.inf], [0.3, 0.3 + 1e-9, 0.1], [math.inf, math.inf, 0.0]])
    assert mean_ranks(gaps).tolist() == pytest.approx([(1 + 2.5 + 2.5) / 3, (2 + 2.5 + 2.5) / 3, (3 + 1 + 1) / 3])


def test_friedman_by_hand() -> None:
    # Rank sums 4, 8, 12 of n = 4, k = 3: chi^2 = 12 / (n k (k + 1)) * 224 - 3 n (k + 1) = 8, and p = exp(-8 / 2).
    assert friedman_p(ALWAYS_IN_ORDER) == pytest.approx(math.exp(-4.0))


def test_friedman_needs_three_methods_and_two_problems() -> None:
    assert friedman_p(ALWAYS_IN_ORDER[:, :2]) is None
    assert friedman_p(ALWAYS_IN_ORDER[:1]) is None
    assert friedman_p(np.full((4, 3), 0.2)) == 1.0


def test_wilcoxon_by_hand() -> None:
    # Six differences of one sign: two of the 2^6 choices of signs are as extreme.
    ours, theirs = np.arange(6) * 0.01, np.arange(6) * 0.02 + 0.005
    assert wilcoxon_p(ours, theirs) == pytest.approx(2 / 64)
    assert wilcoxon_p(theirs, ours) == pytest.approx(2 / 64)


def test_equals_do_not_differ() -> None:
    assert wilcoxon_p(np.array([0.1, math.inf]), np.array([0.1 + 1e-8, math.inf])) == 1.0


def test_holm_by_hand() -> None:
    # Sorted 0.01, 0.03, 0.04 times 3, 2, 1 is 0.03, 0.06, 0.04, and never falls.
    assert holm({"a": 0.01, "b": 0.04, "c": 0.03}) == pytest.approx({"a": 0.03, "b": 0.06, "c": 0.06})


@given(st.dictionaries(st.text(max_size=3), st.floats(0.0, 1.0), max_size=6))
def test_holm_lies_between_the_bare_and_bonferronis(p_values: dict[str, float]) -> None:
    for name, corrected in holm(p_values).items():
        assert p_values[name] <= corrected <= min(1.0, len(p_values) * p_values[name])
