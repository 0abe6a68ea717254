"""Inertia and memory of a particle swarm."""

import numpy as np
import pytest

from planner.search.swarm import INERTIA_FIRST, INERTIA_LAST, SPEED_MAX, falling_inertia, first_swarm, fly


def test_inertia_falls_from_first_to_last() -> None:
    inertia = [falling_inertia(i, 10) for i in range(10)]
    assert inertia[0] == INERTIA_FIRST
    assert inertia[-1] == pytest.approx(INERTIA_LAST)
    assert np.all(np.diff(inertia) < 0)


def test_a_swarm_remembers_the_best_and_not_the_latest() -> None:
    swarm = first_swarm(lambda x: x[:, 0], np.array([[2.0], [3.0]]))
    swarm.positions, swarm.costs = np.array([[5.0], [1.0]]), np.array([5.0, 1.0])
    swarm.remember()
    assert swarm.own_best.tolist() == [[2.0], [1.0]]
    assert swarm.own_costs.tolist() == [2.0, 1.0]
    assert (swarm.best.tolist(), swarm.cost) == ([1.0], 1.0)


def test_no_particle_flies_faster_than_allowed_or_out_of_the_box() -> None:
    low, high = np.array([-1.0, -1.0]), np.array([1.0, 3.0])
    rng = np.random.default_rng(0)
    swarm = first_swarm(lambda x: x[:, 0], rng.uniform(low, high, (20, 2)))
    swarm.velocities = rng.normal(0, 100, (20, 2))
    before = swarm.positions.copy()
    fly(swarm, 0.9, low, high, rng)
    moved = np.abs(swarm.positions - before)
    assert np.all(moved <= SPEED_MAX * (high - low) + 1e-12)
    assert moved.max() > 0.0
    assert np.all((swarm.positions >= low) & (swarm.positions <= high))
