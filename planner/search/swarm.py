"""The moving parts of particle swarms, equations (32)-(40)."""

from dataclasses import dataclass

import numpy as np

from planner.search.objective import FloatArray, Objective

POPULATION = 40
"""Particles where starts are no swarm of their own; that of the standard PSO of 2011."""
FEWEST = 4
"""So many starts are a swarm of their own."""
INERTIA_FIRST, INERTIA_LAST = 0.9, 0.4
"""w_max and w_min of (40); the values of Shi and Eberhart (1998)."""
ACCELERATION = 2.0
"""a_1 = a_2 of (39), the same source."""
SPEED_MAX = 0.1
"""Largest velocity, in widths of the box an iteration: beyond, a swarm of paths loses its shape."""


@dataclass
class Swarm:
    """Particles, their velocities, and what they remember.

    Attributes:
        positions, velocities: (n, d), equations (32)-(34).
        costs: (n,) of the positions.
        own_best, own_costs: (n, d), (n,): best place of each particle (36).
        best, cost: (d,): best of all (37)-(38).
    """

    positions: FloatArray
    velocities: FloatArray
    costs: FloatArray
    own_best: FloatArray
    own_costs: FloatArray
    best: FloatArray
    cost: float

    def go(self, positions: FloatArray, objective: Objective) -> None:
        """Move every particle, inside the box."""
        self.positions = np.clip(positions, objective.low, objective.high)
        self.costs = objective(self.positions)
        self._remember()

    def go_where_better(self, mutants: FloatArray, objective: Objective) -> None:
        """Equation (45): a particle goes where its mutant is if that is better."""
        mutants = np.clip(mutants, objective.low, objective.high)
        costs = objective(mutants)
        better = costs < self.costs
        self.positions[better] = mutants[better]
        self.costs[better] = costs[better]
        self._remember()

    def _remember(self) -> None:
        """Keep what is better than before, (36)-(38)."""
        better = self.costs < self.own_costs
        self.own_best[better] = self.positions[better]
        self.own_costs[better] = self.costs[better]
        leader = int(np.argmin(self.own_costs))
        if self.own_costs[leader] < self.cost:
            self.best, self.cost = self.own_best[leader].copy(), float(self.own_costs[leader])


def first_swarm(objective: Objective, starts: FloatArray, rng: np.random.Generator) -> Swarm:
    """A swarm at rest, evaluated once: the starts, with random particles up to `POPULATION` where they are too few."""
    others = objective.random(POPULATION - len(starts) if len(starts) < FEWEST else 0, rng)
    positions = np.concatenate([starts, others])
    costs = objective(positions)
    leader = int(np.argmin(costs))
    return Swarm(
        positions=positions,
        velocities=np.zeros_like(positions),
        costs=costs,
        own_best=positions.copy(),
        own_costs=costs.copy(),
        best=positions[leader].copy(),
        cost=float(costs[leader]),
    )


def falling_inertia(progress: float) -> float:
    """w of (40), corrected: from `INERTIA_FIRST` at progress 0 to `INERTIA_LAST` at 1."""
    return INERTIA_FIRST - (INERTIA_FIRST - INERTIA_LAST) * progress


def velocities(swarm: Swarm, inertia: float, rng: np.random.Generator) -> FloatArray:
    """(n, d) by (39)."""
    own, common = rng.random((2, *swarm.positions.shape))
    to_own = own * (swarm.own_best - swarm.positions)
    to_best = common * (swarm.best - swarm.positions)
    faster: FloatArray = inertia * swarm.velocities + ACCELERATION * (to_own + to_best)
    return faster


def fly(swarm: Swarm, objective: Objective, rng: np.random.Generator) -> None:
    """Move every particle by (39), with falling inertia and no faster than `SPEED_MAX`."""
    fastest = SPEED_MAX * (objective.high - objective.low)
    swarm.velocities = np.clip(velocities(swarm, falling_inertia(objective.progress), rng), -fastest, fastest)
    swarm.go(swarm.positions + swarm.velocities, objective)
