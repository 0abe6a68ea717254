"""What is true of every search."""

import numpy as np
import pytest
from scipy.optimize import OptimizeResult

from planner.search import minimize
from planner.search.methods import METHODS
from planner.search.objective import FloatArray

BOX = np.array([[-5.0, 5.0], [-2.0, 20.0], [0.5, 1.5], [-5.0, 5.0], [-9.0, 1.0], [-5.0, 5.0]])
LOW, HIGH = BOX.T
OURS = ("skein", "pso", "qpso", "hybrid", "published")

every_method = pytest.mark.parametrize("method", METHODS)


def sphere(x: FloatArray) -> FloatArray:
    return np.sum((x - 1.0) ** 2, axis=1)


def rastrigin(x: FloatArray) -> FloatArray:
    return np.sum(x**2 - 10 * np.cos(2 * np.pi * x) + 10, axis=1)


def run(method: str, fun: object = sphere, *, budget: int = 1500, seed: int = 3, **more: object) -> OptimizeResult:
    return minimize(fun, BOX, method=method, budget=budget, seed=seed, **more)  # type: ignore[arg-type]


@every_method
@pytest.mark.parametrize("budget", [1, 2, 39, 41, 119, 500, 1001])
def test_the_budget_is_used_and_never_exceeded(method: str, budget: int) -> None:
    counted = 0

    def counting(x: FloatArray) -> FloatArray:
        nonlocal counted
        counted += len(x)
        return rastrigin(x)

    result = run(method, counting, budget=budget)
    assert result.nfev == counted == budget
    assert result.success
    assert result.status == 0


@every_method
def test_never_leaves_the_box_and_finds_its_corner(method: str) -> None:
    def corner(x: FloatArray) -> FloatArray:
        assert np.all((x >= LOW) & (x <= HIGH))
        return np.sum((x - LOW) / (HIGH - LOW), axis=1)

    result = run(method, corner)
    assert np.all((result.x >= LOW) & (result.x <= HIGH))
    assert result.fun < 0.6  # a random point has 3, the best of 1500 random points 0.9


@every_method
def test_the_result_is_the_best_point_that_was_evaluated(method: str) -> None:
    seen: list[tuple[float, FloatArray]] = []

    def watched(x: FloatArray) -> FloatArray:
        costs = rastrigin(x)
        leader = int(np.argmin(costs))
        seen.append((float(costs[leader]), x[leader].copy()))
        return costs

    result = run(method, watched)
    cost, point = min(seen, key=lambda one: one[0])
    assert result.fun == cost
    assert np.array_equal(result.x, point)
    assert result.nit == len(seen)


@every_method
def test_the_same_seed_gives_the_same_bits_and_another_does_not(method: str) -> None:
    before = np.random.get_state()[1]
    first, again, other = run(method, rastrigin), run(method, rastrigin), run(method, rastrigin, seed=4)
    assert np.array_equal(first.x, again.x)
    assert np.array_equal(first.history, again.history)
    assert not np.array_equal(first.x, other.x)
    assert np.array_equal(before, np.random.get_state()[1])  # nobody else's chance is touched


@every_method
def test_history_and_callback_tell_of_each_batch(method: str) -> None:
    told: list[tuple[int, float, int]] = []
    result = run(method, rastrigin, callback=lambda now: told.append((now.nfev, now.fun, now.nit)))
    evaluations, best = result.history.T
    assert np.all(np.diff(evaluations) > 0)
    assert np.all(np.diff(best) <= 0)
    assert (evaluations[-1], best[-1]) == (result.nfev, result.fun)
    assert told == [(*line, i + 1) for i, line in enumerate(map(tuple, result.history))]


@every_method
def test_the_callback_may_end_the_search(method: str) -> None:
    told = 0

    def enough(now: OptimizeResult) -> None:
        nonlocal told
        told += 1
        if now.nfev >= 300:
            raise StopIteration

    result = run(method, callback=enough)
    assert 300 <= result.nfev < 1500
    assert result.nit == told
    assert result.status == 99
    assert "StopIteration" in result.message


@every_method
@pytest.mark.filterwarnings("error")
def test_costs_that_are_no_numbers_are_the_worst(method: str) -> None:
    def holes(x: FloatArray) -> FloatArray:
        return np.where(x[:, 0] < 0.0, np.nan, sphere(x))

    result = run(method, holes)
    assert result.x[0] >= 0.0
    assert result.fun < 5.0
    nowhere = run(method, lambda x: np.full(len(x), np.nan), budget=300)
    assert (nowhere.fun, nowhere.success, nowhere.nfev) == (np.inf, False, 300)


@every_method
@pytest.mark.parametrize("points", [1, 3, 100])
def test_no_result_is_worse_than_a_start(method: str, points: int) -> None:
    starts = np.random.default_rng(0).uniform(LOW, HIGH, (points, 6))
    starts[points // 2] = np.clip(1.0, LOW + 1e-3, HIGH)
    kept = starts.copy()
    best = sphere(starts).min()
    assert run(method, x0=starts, budget=101).fun <= best + 1e-12
    assert np.array_equal(starts, kept)
    assert run(method, x0=starts[points // 2], budget=101).fun <= best + 1e-12


@every_method
def test_an_error_in_the_function_comes_through(method: str) -> None:
    def broken(x: FloatArray) -> FloatArray:
        raise ZeroDivisionError("no")

    with pytest.raises(ZeroDivisionError, match="no"):
        run(method, broken)


@every_method
def test_finds_the_middle_of_a_sphere(method: str) -> None:
    tolerance = 0.5 if method in ("published", "pyswarms") else 0.01
    assert run(method, budget=6000).fun < tolerance
