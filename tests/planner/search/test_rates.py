"""How fast an evolution learns."""

import cma
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from planner.search.rates import rates


@given(st.integers(1, 200), st.integers(4, 400))
def test_the_covariance_stays_positive_and_better_points_weigh_more(dimension: int, points: int) -> None:
    r = rates(dimension, points)
    better = r.weights[: points // 2]
    assert better.sum() == pytest.approx(1.0)
    assert np.all(better > 0.0)
    assert np.all(np.diff(r.weights[: points // 2]) < 0.0)
    assert 1.0 <= r.effective <= points // 2
    # What negative weights may take away is no more than what is kept.
    taken = -r.rank_many * r.weights[r.weights < 0.0].sum() * dimension
    assert taken <= 1.0 - r.rank_one - r.rank_many + 1e-12
    assert all(0.0 < rate <= 1.0 for rate in (r.path, r.step, r.rank_one, r.rank_many))


@pytest.mark.parametrize(("dimension", "points"), [(2, 6), (10, 10), (36, 14), (36, 112), (120, 18)])
def test_they_are_those_of_the_methods_author(dimension: int, points: int) -> None:
    strategy = cma.CMAEvolutionStrategy([0.0] * dimension, 1.0, {"popsize": points, "verbose": -9})
    ours, theirs = rates(dimension, points), strategy.sp
    assert ours.weights == pytest.approx(np.array(theirs.weights))
    assert (ours.effective, ours.rank_one, ours.rank_many) == pytest.approx(
        (theirs.weights.mueff, theirs.c1, theirs.cmu)
    )
