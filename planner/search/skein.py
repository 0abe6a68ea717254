"""Skein's own search for any cost: many evolutions at first, of which the better half goes on, again and again.

One evolution of a normal distribution converges fast and certainly, but to the valley that it began to descend: round
this or that side of an obstacle. A small first step finds the valley of its start, a large one chooses among many and
takes longer. So evolutions with all kinds of steps begin side by side, and evaluations go to those that are ahead. When
the one that is left has converged, others follow with large steps and ever more points a generation, by turns from the
best point and from anywhere.
"""

import numpy as np

from planner.search.evolution import Evolution
from planner.search.objective import FloatArray, Objective
from planner.search.rates import population

SHARE = 20
"""Evaluations a number after which evolutions are first compared; twice as many each time after."""
CONTEST = 0.5
"""Part of the budget that comparing may take; as many evolutions begin as that allows."""
STEPS = 0.02, 0.2
"""First steps in widths of the box: of the first evolutions, from the smallest to below the largest; of later ones."""
GROWTH = 2
"""Of the points a generation from restart to restart: Auger and Hansen (2005)."""


def skein(objective: Objective, starts: FloatArray, rng: np.random.Generator) -> None:
    """From the best of the starts, or the middle of the box."""
    places = _places(objective, starts)
    points = population(objective.dimension)
    share = max(1, round(SHARE * objective.dimension / points))
    rounds = _rounds(objective)
    evolutions = [
        Evolution(places[i % len(places)], step, points)
        for i, step in enumerate(np.geomspace(*STEPS, 2**rounds, endpoint=False).tolist())
    ]
    for number in range(rounds):
        for evolution in evolutions:
            evolution.run(objective, rng, until=share * 2**number)
        evolutions.sort(key=lambda evolution: evolution.cost)
        del evolutions[len(evolutions) // 2 :]
    best = evolutions[0]
    best.run(objective, rng)
    while True:
        points *= GROWTH
        for place in (best.best, rng.random(objective.dimension)):
            again = Evolution(place, STEPS[1], points)
            again.run(objective, rng)
            best = min(best, again, key=lambda evolution: evolution.cost)


def _places(objective: Objective, starts: FloatArray) -> FloatArray:
    """(n, d) where evolutions begin, the best first, in a box of sides 1."""
    if not len(starts):
        return np.full((1, objective.dimension), 0.5)
    ahead = starts[np.argsort(objective(starts), kind="stable")]
    places: FloatArray = (ahead - objective.low) / (objective.high - objective.low)
    return places


def _rounds(objective: Objective) -> int:
    """How often evolutions are compared and halved."""
    rounds = 0
    while (rounds + 1) * 2 ** (rounds + 1) * SHARE * objective.dimension <= CONTEST * objective.left:
        rounds += 1
    return rounds
