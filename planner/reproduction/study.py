"""Every entrant's search for the path of every UAV, by several seeds, from first swarms that know no straight line."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from missions.scenario import Scenario, VehicleModel
from planner.cost.kernel import INFEASIBLE_KM
from planner.find_path import SKEIN, History, vehicle_problem
from planner.reproduction.entrants import Entrant, entrants
from planner.search import minimize
from planner.search.waves import wave_view
from planner.skein.search import skein_path

FloatArray = npt.NDArray[np.float64]

STUDY_STREAM = 5
"""Purpose of the random streams of studies, beside seed and sysid."""
SETTLED = 0.01
"""A search has converged when it is within this part of what it ends with."""


@dataclass(frozen=True)
class Outcome:
    """What one entrant found.

    Attributes:
        entrant: which.
        costs_km: (seeds, UAVs) best feasible cost; infinite where it found no feasible path.
        histories: of the same searches, by seed and UAV: evaluations, and the best cost after so many.
    """

    entrant: Entrant
    costs_km: FloatArray
    histories: tuple[tuple[History, ...], ...]

    @property
    def totals_km(self) -> FloatArray:
        """(seeds,) sum over all UAVs; infinite when one has no feasible path."""
        totals: FloatArray = self.costs_km.sum(axis=1)
        return totals

    def best_after_km(self, evaluations: npt.ArrayLike) -> FloatArray:
        """(seeds, UAVs, len(evaluations)) best feasible cost after so many evaluations of one UAV's search."""
        return np.array([[_best_after(one, evaluations) for one in of_seed] for of_seed in self.histories])

    def settled(self) -> FloatArray:
        """(seeds, UAVs) evaluations until within `SETTLED` of the end; NaN where no feasible path was found."""
        return np.array([[_settled(history) for history in of_seed] for of_seed in self.histories])


@dataclass(frozen=True)
class Study:
    """All outcomes on one scenario.

    Attributes:
        scenario: of all.
        seeds: of the rows of each outcome.
        outcomes: one an entrant.
    """

    scenario: Scenario
    seeds: tuple[int, ...]
    outcomes: tuple[Outcome, ...]


def study(scenario: Scenario, seeds: Sequence[int], progress: Callable[[float], None]) -> Study:
    """Have every entrant search for the path of every UAV, alone in the air: others' conflicts would make the later
    UAVs' problems depend on what was found for the earlier ones.

    Swarms begin as the paper's do, with random solutions: waves of random size about the straight line
    (`planner.search.waves`), the line itself not among them. Waypoints anywhere in the area would be more random
    still, but then no swarm comes to keep the limits (12) with the budget of a plan.

    Args:
        scenario: with origins and targets.
        seeds: of all chance.
        progress: told which part is done, 0 to 1.
    """
    field = entrants(scenario)
    steps, done = len(field) * len(seeds) * len(scenario.vehicles), 0
    outcomes = []
    for entrant in field:
        histories: list[tuple[History, ...]] = []
        for seed in seeds:
            of_seed: list[History] = []
            for vehicle in scenario.vehicles:
                of_seed.append(_search(scenario, vehicle, entrant, seed))
                done += 1
                progress(done / steps)
            histories.append(tuple(of_seed))
        costs_km = [[_feasible(history[-1][1]) for history in of_seed] for of_seed in histories]
        outcomes.append(Outcome(entrant, np.array(costs_km), tuple(histories)))
    return Study(scenario, tuple(seeds), tuple(outcomes))


def _search(scenario: Scenario, vehicle: VehicleModel, entrant: Entrant, seed: int) -> History:
    """One entrant's search for one path; it has at least one line."""
    settings, problem = scenario.search, vehicle_problem(scenario, vehicle)
    chance = np.random.SeedSequence([seed, STUDY_STREAM, vehicle.sysid])
    if entrant.method == SKEIN:
        own = int(chance.generate_state(1)[0])
        found = skein_path(problem, settings.waypoints, budget=entrant.evaluations, seed=own, report=lambda *_: None)
        return (*found.history, (found.nfev, found.fun))
    view, rng = wave_view(problem, settings.waypoints, settings.reading), np.random.default_rng(chance)
    result = minimize(
        view.fun,
        view.bounds,
        method=entrant.method,
        budget=entrant.evaluations,
        seed=rng,
        x0=rng.uniform(view.bounds[:, 0], view.bounds[:, 1], (settings.population, len(view.bounds))),
    )
    return tuple((int(evaluations), float(cost)) for evaluations, cost in result.history)


def _feasible(cost_km: float) -> float:
    return cost_km if cost_km < INFEASIBLE_KM else np.inf


def _best_after(history: History, evaluations: npt.ArrayLike) -> FloatArray:
    known = np.array([entry[0] for entry in history])
    costs = np.array([np.inf, *(_feasible(cost) for _, cost in history)])
    best: FloatArray = costs[np.searchsorted(known, evaluations, side="right")]
    return best


def _settled(history: History) -> float:
    last = history[-1][1]
    if last >= INFEASIBLE_KM:
        return np.nan
    return next(evaluations for evaluations, cost in history if cost <= last * (1.0 + SETTLED))
