"""The paper's hybrid: a particle swarm with Cauchy mutants, equations (39)-(48), corrected as MODEL, section 4 says."""

import numpy as np

from planner.search.search import Cost, FloatArray, Report, SearchResult
from planner.search.swarm import Swarm, falling_inertia, first_swarm, fly


def hybrid(
    cost: Cost,
    swarm: FloatArray,
    low: FloatArray,
    high: FloatArray,
    *,
    budget: int,
    rng: np.random.Generator,
    report: Report,
) -> SearchResult:
    """Steps 1-8 of the paper: each iteration moves every particle by (39), then tries the map operator (44) and the
    landmark operator (48) on it and keeps what is better; three evaluations a particle an iteration."""
    particles = first_swarm(cost, swarm)
    iterations = (budget // len(swarm) - 1) // 3
    history = []
    for i in range(iterations):
        fly(particles, falling_inertia(i, iterations), low, high, rng)
        particles.costs = cost(particles.positions)
        particles.remember()
        c1 = np.tan(np.pi * (rng.random((len(swarm), 1)) - 0.5))  # (43)
        _keep_better(
            particles, cost, np.clip(particles.positions + c1 * (particles.positions - particles.best), low, high)
        )
        c2 = np.tan(0.5 * np.pi * rng.random((len(swarm), 1)))  # (47) as (46) has it
        _keep_better(
            particles, cost, np.clip(particles.positions + c2 * (particles.best - particles.positions), low, high)
        )
        particles.evaluations += 3 * len(swarm)
        history.append(particles.cost)
        report(i + 1, iterations, particles.cost)
    return SearchResult(particles.best, particles.cost, tuple(history), particles.evaluations)


def _keep_better(particles: Swarm, cost: Cost, mutants: FloatArray) -> None:
    """Equation (45): a particle goes where its mutant is if that is better."""
    costs = cost(mutants)
    better = costs < particles.costs
    particles.positions[better] = mutants[better]
    particles.costs[better] = costs[better]
    particles.remember()
