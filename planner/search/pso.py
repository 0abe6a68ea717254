"""Particle swarm optimisation, equations (32)-(40)."""

import numpy as np

from planner.search.search import Cost, FloatArray, Report, SearchResult
from planner.search.swarm import falling_inertia, first_swarm, fly


def pso(
    cost: Cost,
    swarm: FloatArray,
    low: FloatArray,
    high: FloatArray,
    *,
    budget: int,
    rng: np.random.Generator,
    report: Report,
) -> SearchResult:
    """Particle swarm with inertia falling from iteration to iteration; one evaluation a particle an iteration."""
    particles = first_swarm(cost, swarm)
    iterations = budget // len(swarm) - 1
    history = []
    for i in range(iterations):
        fly(particles, falling_inertia(i, iterations), low, high, rng)
        particles.costs = cost(particles.positions)
        particles.evaluations += len(swarm)
        particles.remember()
        history.append(particles.cost)
        report(i + 1, iterations, particles.cost)
    return SearchResult(particles.best, particles.cost, tuple(history), particles.evaluations)
