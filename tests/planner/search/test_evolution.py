"""Covariance matrix adaptation."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from planner.search.evolution import Evolution, folded
from planner.search.objective import BudgetSpent, FloatArray, Fun, Objective
from planner.search.rates import population


def objective(fun: Fun, dimension: int, budget: int) -> Objective:
    return Objective(fun, np.zeros(dimension), np.ones(dimension), budget)


def ellipsoid(x: FloatArray) -> FloatArray:
    """Axes of lengths 1 to 1000, turned, about 0.4."""
    d = x.shape[1]
    turn = np.linalg.qr(np.random.default_rng(5).normal(size=(d, d)))[0]
    return np.sum(10.0 ** np.linspace(0.0, 6.0, d) * ((x - 0.4) @ turn) ** 2, axis=1)


def evolved(fun: Fun, dimension: int, budget: int, step: float = 0.1) -> tuple[Evolution, Objective]:
    evolution, of = Evolution(np.full(dimension, 0.6), step, population(dimension)), objective(fun, dimension, budget)
    evolution.run(of, np.random.default_rng(1))
    return evolution, of


unit_box = arrays(np.float64, (3, 4), elements=st.floats(-50.0, 50.0))


@given(unit_box)
def test_folding_keeps_what_is_inside_and_never_stretches(points: FloatArray) -> None:
    inside = folded(points)
    assert np.all((inside >= 0.0) & (inside <= 1.0))
    assert folded(inside) == pytest.approx(inside, abs=1e-12)
    assert np.all(np.abs(folded(points + 0.01) - inside) <= 0.01 + 1e-12)
    assert folded(-points) == pytest.approx(inside, abs=1e-12)  # a wall is a mirror
    assert folded(2.0 - points) == pytest.approx(inside, abs=1e-12)


@pytest.mark.parametrize("dimension", [1, 2, 10])
def test_learns_the_shape_of_an_ellipsoid(dimension: int) -> None:
    """The ratio of axes that it has learnt is that of the function, and so it converges."""
    evolution, of = evolved(ellipsoid, dimension, 20000)
    assert evolution.over
    assert evolution.cost < 1e-12
    assert of.spent < 1500 * dimension
    assert evolution.best == pytest.approx(np.full(dimension, 0.4), abs=1e-6)


def test_only_the_order_of_costs_matters() -> None:
    budget = 40 * population(5)
    places = []
    for fun in (ellipsoid, lambda x: np.exp(ellipsoid(x) / 1e5) * 1e3):
        of = objective(fun, 5, budget)
        with pytest.raises(BudgetSpent):
            Evolution(np.full(5, 0.6), 0.1, population(5)).run(of, np.random.default_rng(1))
        places.append(of.best)
    assert np.array_equal(*places)


def test_on_a_slope_the_step_grows_and_on_noise_it_stays() -> None:
    def spread(fun: Fun) -> float:
        seen: list[FloatArray] = []

        def watched(x: FloatArray) -> FloatArray:
            seen.append(x)
            return fun(x)

        Evolution(np.full(20, 0.5), 1e-6, population(20)).run(
            objective(watched, 20, 10**6), np.random.default_rng(0), until=60
        )
        return float(seen[-1].std(axis=0).mean() / seen[0].std(axis=0).mean())

    rng = np.random.default_rng(3)
    assert spread(lambda x: x[:, 0]) > 20.0
    assert 0.2 < spread(lambda x: rng.random(len(x))) < 3.0


@pytest.mark.parametrize("cost", [1.0, math.inf])
def test_ends_where_all_costs_are_the_same(cost: float) -> None:
    evolution, of = evolved(lambda x: np.full(len(x), cost), 6, 10**6)
    assert evolution.over
    assert of.spent < 100 * population(6)


def test_stops_after_so_many_generations_and_goes_on() -> None:
    evolution, of = Evolution(np.full(6, 0.6), 0.1, population(6)), objective(ellipsoid, 6, 10**6)
    rng = np.random.default_rng(0)
    for until, so_many in ((7, 7), (7, 7), (5, 7), (12, 12)):
        evolution.run(of, rng, until=until)
        assert of.spent == so_many * population(6)
    assert not evolution.over


def test_an_optimum_in_a_corner_is_found() -> None:
    evolution, _ = evolved(lambda x: np.sum(x, axis=1), 8, 20000)
    assert evolution.cost < 1e-4
