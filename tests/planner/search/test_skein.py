"""Skein's own search for any cost."""

import numpy as np
import pytest

from planner.search import minimize
from planner.search.objective import FloatArray
from planner.search.rates import population

BOX = [(-5.0, 5.0)] * 6


def two_valleys(x: FloatArray) -> FloatArray:
    """One about the middle, with the cost 1, and one as wide at 3, with the cost 0."""
    return np.minimum(1.0 + np.sum(x**2, axis=1), np.sum((x - 3.0) ** 2, axis=1))


def rosenbrock(x: FloatArray) -> FloatArray:
    return np.sum(100.0 * (x[:, 1:] - x[:, :-1] ** 2) ** 2 + (1.0 - x[:, :-1]) ** 2, axis=1)


def rastrigin(x: FloatArray) -> FloatArray:
    y = x - 1.7
    return np.sum(y**2 - 10.0 * np.cos(2.0 * np.pi * y) + 10.0, axis=1)


@pytest.mark.parametrize("seed", [0, 1, 2])
def test_finds_its_way_along_a_bent_valley(seed: int) -> None:
    assert minimize(rosenbrock, BOX, budget=2000 * 6, seed=seed).fun < 1e-8


@pytest.mark.parametrize("seed", [0, 1, 2])
def test_comes_out_of_the_valley_it_came_to_first(seed: int) -> None:
    early = minimize(two_valleys, BOX, budget=100 * 6, seed=seed)
    late = minimize(two_valleys, BOX, budget=4000 * 6, seed=seed)
    assert early.fun > 0.99
    assert late.fun < 1e-6


@pytest.mark.parametrize("seed", [0, 1, 2])
def test_of_many_valleys_one_of_the_best_is_found(seed: int) -> None:
    assert (
        minimize(rastrigin, BOX, budget=2000 * 6, seed=seed).fun < 3.5
    )  # a random valley has 50, those next to the best have 1


def test_begins_in_the_middle_or_at_the_best_start() -> None:
    def first_points(**more: object) -> FloatArray:
        seen: list[FloatArray] = []

        def watched(x: FloatArray) -> FloatArray:
            seen.append(x)
            return rastrigin(x)

        minimize(watched, BOX, budget=100, seed=0, **more)  # type: ignore[arg-type]
        return next(x for x in seen if len(x) == population(6))

    assert np.abs(first_points()).max() < 1.0
    starts = np.array([[4.0] * 6, [1.7] * 6])
    assert np.abs(first_points(x0=starts) - 1.7).max() < 1.0


def test_a_bigger_budget_begins_more_evolutions() -> None:
    """Each first generation lies about the middle, whatever has been found so far."""

    def beginnings(budget: int) -> int:
        middles = []

        def watched(x: FloatArray) -> FloatArray:
            middles.append(np.abs(x.mean(axis=0)).max())
            return np.sum((x - 4.0) ** 2, axis=1)

        minimize(watched, BOX, budget=budget, seed=0)
        return int(np.sum(np.array(middles) < 1.0))

    few, many = beginnings(100 * 6), beginnings(2000 * 6)
    assert many > few
