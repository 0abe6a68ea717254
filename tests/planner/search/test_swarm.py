"""Inertia, memory and motion of particle swarms, and the places that each variant of them tries."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from planner.search.cauchy import landmark_mutants, map_mutants, printed_landmark_mutants
from planner.search.objective import Objective
from planner.search.published import printed_inertia
from planner.search.qpso import quantum_positions
from planner.search.swarm import (
    FEWEST,
    INERTIA_FIRST,
    INERTIA_LAST,
    POPULATION,
    SPEED_MAX,
    Swarm,
    falling_inertia,
    first_swarm,
    fly,
    velocities,
)

RNG = np.random.default_rng(0)
BEST = np.array([1.0, -2.0])
chances = st.floats(0.01, 0.99)


def objective(low: float = -10.0, high: float = 10.0, dimension: int = 2, budget: int = 1000) -> Objective:
    return Objective(lambda x: x[:, 0], np.full(dimension, low), np.full(dimension, high), budget)


def swarm_at(*positions: tuple[float, float]) -> Swarm:
    at = np.array(positions)
    return Swarm(at, np.zeros_like(at), np.zeros(len(at)), at.copy(), np.zeros(len(at)), BEST, 0.0)


def test_inertia_falls_from_first_to_last_and_rises_as_printed() -> None:
    assert (falling_inertia(0.0), falling_inertia(1.0)) == (INERTIA_FIRST, pytest.approx(INERTIA_LAST))
    assert falling_inertia(0.5) == pytest.approx((INERTIA_FIRST + INERTIA_LAST) / 2)
    assert (printed_inertia(0.0), printed_inertia(1.0)) == (0.0, INERTIA_FIRST - INERTIA_LAST)


def test_a_swarm_remembers_the_best_and_not_the_latest() -> None:
    line = objective(dimension=1)
    swarm = first_swarm(line, np.linspace(2.0, 9.0, POPULATION)[:, None], RNG)
    swarm.go(swarm.positions + np.where(np.arange(POPULATION) == 1, -8.0, 1.0)[:, None], line)
    assert swarm.own_best[0] == 2.0
    assert swarm.own_best[1] == swarm.best == swarm.positions[1]
    assert swarm.cost == swarm.own_costs[1] == swarm.best[0]


def test_a_particle_goes_only_where_its_mutant_is_better() -> None:
    line = objective(dimension=1)
    swarm = first_swarm(line, np.arange(POPULATION, dtype=np.float64)[:, None] / 10, RNG)
    before = swarm.positions.copy()
    step = np.where(np.arange(POPULATION) % 2, 1.0, -1.0)[:, None]
    swarm.go_where_better(before + step, line)
    assert np.array_equal(swarm.positions, np.minimum(before, before + step))
    assert np.array_equal(swarm.costs, swarm.positions[:, 0])


def test_a_first_swarm_is_the_starts_and_random_others() -> None:
    starts = np.array([[3.0, 4.0], [5.0, 6.0]])
    few = first_swarm(objective(), starts, RNG)
    assert np.array_equal(few.positions[:2], starts)
    assert len(np.unique(few.positions, axis=0)) == POPULATION
    for own in (FEWEST, 70):
        swarm = RNG.uniform(-10, 10, (own, 2))
        assert np.array_equal(first_swarm(objective(), swarm, RNG).positions, swarm)


def test_no_particle_flies_faster_than_allowed_or_out_of_the_box() -> None:
    box = objective(-1.0, 1.0)
    swarm = first_swarm(box, np.empty((0, 2)), RNG)
    swarm.velocities = RNG.normal(0, 100, swarm.positions.shape)
    before = swarm.positions.copy()
    fly(swarm, box, RNG)
    moved = np.abs(swarm.positions - before)
    assert moved.max() == pytest.approx(SPEED_MAX * 2.0)
    assert np.all((swarm.positions >= box.low) & (swarm.positions <= box.high))


def test_velocities_at_the_best_are_inertia_alone() -> None:
    swarm = swarm_at((1.0, -2.0))
    swarm.velocities = np.array([[3.0, 5.0]])
    assert velocities(swarm, 0.4, RNG) == pytest.approx(np.array([[1.2, 2.0]]))


@given(chances)
def test_the_map_operator_inverts_its_distribution(chance: float) -> None:
    swarm = swarm_at((3.0, 2.0))
    c1 = (map_mutants(swarm, np.array([[chance]])) - swarm.positions) / (swarm.positions - BEST)
    assert np.arctan(c1) / np.pi + 0.5 == pytest.approx(np.full((1, 2), chance))  # (42)


@given(chances)
def test_the_landmark_operator_inverts_its_distribution_and_the_printed_one_does_not(chance: float) -> None:
    swarm = swarm_at((3.0, 2.0))
    c2 = (landmark_mutants(swarm, np.array([[chance]])) - swarm.positions) / (BEST - swarm.positions)
    assert 2.0 / np.pi * np.arctan(c2) == pytest.approx(np.full((1, 2), chance))  # (46)
    printed = (printed_landmark_mutants(swarm, np.array([[chance]])) - swarm.positions) / (BEST - swarm.positions)
    assert printed == pytest.approx(np.full((1, 2), np.tan(2.0 / np.pi * chance)))  # (47)
    assert np.all(printed < 0.74)


def test_quantum_positions_in_closed_form() -> None:
    swarm = swarm_at((3.0, 2.0), (5.0, -4.0))
    half, none = np.full((2, 2), 0.5), np.zeros((2, 2))
    middle = 0.5 * (swarm.own_best + BEST)
    assert quantum_positions(swarm, 0.7, half, none, half) == pytest.approx(middle)
    depth = np.full((2, 2), 1.0 - np.exp(-1.0))  # ln(1 / u) = 1
    spread = 0.7 * np.abs(np.array([4.0, -1.0]) - swarm.positions)
    assert quantum_positions(swarm, 0.7, half, depth, none) == pytest.approx(middle - spread)
    assert quantum_positions(swarm, 0.7, half, depth, half) == pytest.approx(middle + spread)
