"""What is true of every search."""

import numpy as np
import pytest

from planner.find_path import SEARCHES
from planner.search.search import FloatArray, Search, SearchResult

LOW, HIGH = np.full(6, -5.0), np.full(6, 5.0)

every_search = pytest.mark.parametrize("search", SEARCHES.values(), ids=SEARCHES.keys())


def sphere(x: FloatArray) -> FloatArray:
    return np.sum((x - 1.0) ** 2, axis=1)


def rastrigin(x: FloatArray) -> FloatArray:
    return np.sum(x**2 - 10 * np.cos(2 * np.pi * x) + 10, axis=1)


def run(search: Search, cost: object = sphere, *, budget: int = 9000, seed: int = 3) -> SearchResult:
    rng = np.random.default_rng(seed)
    swarm = rng.uniform(LOW, HIGH, (30, 6))
    return search(cost, swarm, LOW, HIGH, budget=budget, rng=rng, report=lambda *_: None)  # type: ignore[arg-type]


@every_search
def test_finds_the_middle_of_a_sphere(search: Search) -> None:
    result = run(search)
    assert result.cost < 1e-3
    assert result.best == pytest.approx(np.ones(6), abs=0.05)
    assert result.cost == pytest.approx(sphere(result.best[None])[0])


@every_search
def test_gets_far_on_rastrigin(search: Search) -> None:
    first = float(rastrigin(np.random.default_rng(3).uniform(LOW, HIGH, (30, 6))).min())
    assert run(search, rastrigin).cost < first / 4


@every_search
@pytest.mark.parametrize("budget", [30, 31, 119, 120, 121, 1000, 8999])
def test_the_budget_is_never_exceeded(search: Search, budget: int) -> None:
    counted = 0

    def counting(x: FloatArray) -> FloatArray:
        nonlocal counted
        counted += len(x)
        return sphere(x)

    result = run(search, counting, budget=budget)
    assert result.evaluations == counted <= budget
    assert budget - counted < 3 * 30


@every_search
def test_history_falls_to_the_best_and_progress_tells_of_it(search: Search) -> None:
    told: list[tuple[int, int, float]] = []
    rng = np.random.default_rng(1)
    result = search(
        sphere, rng.uniform(LOW, HIGH, (30, 6)), LOW, HIGH, budget=3000, rng=rng, report=lambda *now: told.append(now)
    )
    assert list(result.history) == sorted(result.history, reverse=True)
    assert result.history[-1] == result.cost
    assert told == [(i + 1, len(result.history), best) for i, best in enumerate(result.history)]


@every_search
def test_never_leaves_the_box(search: Search) -> None:
    def corner(x: FloatArray) -> FloatArray:
        assert np.all((x >= LOW) & (x <= HIGH))
        return np.sum(x, axis=1)

    assert run(search, corner).best == pytest.approx(LOW)


@every_search
def test_the_same_seed_gives_the_same_bits_and_another_does_not(search: Search) -> None:
    first, again, other = run(search), run(search), run(search, seed=4)
    assert np.array_equal(first.best, again.best)
    assert first.history == again.history
    assert not np.array_equal(first.best, other.best)


@every_search
def test_the_first_population_is_not_changed(search: Search) -> None:
    swarm = np.random.default_rng(0).uniform(LOW, HIGH, (30, 6))
    kept = swarm.copy()
    search(sphere, swarm, LOW, HIGH, budget=900, rng=np.random.default_rng(0), report=lambda *_: None)
    assert np.array_equal(swarm, kept)
