"""The moving parts of particle swarms, equations (32)-(40)."""

from dataclasses import dataclass

import numpy as np

from planner.search.search import Cost, FloatArray

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
        evaluations: so far.
    """

    positions: FloatArray
    velocities: FloatArray
    costs: FloatArray
    own_best: FloatArray
    own_costs: FloatArray
    best: FloatArray
    cost: float
    evaluations: int

    def remember(self) -> None:
        """Keep what is better than before, (36)-(38)."""
        better = self.costs < self.own_costs
        self.own_best[better] = self.positions[better]
        self.own_costs[better] = self.costs[better]
        leader = int(np.argmin(self.own_costs))
        if self.own_costs[leader] < self.cost:
            self.best, self.cost = self.own_best[leader].copy(), float(self.own_costs[leader])


def first_swarm(cost: Cost, positions: FloatArray) -> Swarm:
    """A swarm at rest, evaluated once."""
    costs = cost(positions)
    leader = int(np.argmin(costs))
    return Swarm(
        positions=positions.copy(),
        velocities=np.zeros_like(positions),
        costs=costs,
        own_best=positions.copy(),
        own_costs=costs.copy(),
        best=positions[leader].copy(),
        cost=float(costs[leader]),
        evaluations=len(positions),
    )


def falling_inertia(iteration: int, iterations: int) -> float:
    """w of (40), corrected: from `INERTIA_FIRST` in iteration 0 to `INERTIA_LAST` in the last."""
    return INERTIA_FIRST - (INERTIA_FIRST - INERTIA_LAST) * iteration / max(iterations - 1, 1)


def fly(swarm: Swarm, inertia: float, low: FloatArray, high: FloatArray, rng: np.random.Generator) -> None:
    """Move every particle by (39), inside the box. Its cost is not known afterwards."""
    own, common = rng.random((2, *swarm.positions.shape))
    velocities = (
        inertia * swarm.velocities
        + ACCELERATION * own * (swarm.own_best - swarm.positions)
        + ACCELERATION * common * (swarm.best - swarm.positions)
    )
    fastest = SPEED_MAX * (high - low)
    swarm.velocities = np.clip(velocities, -fastest, fastest)
    swarm.positions = np.clip(swarm.positions + swarm.velocities, low, high)
