"""The search for one UAV's path."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from scipy.optimize import OptimizeResult

from missions.scenario import Scenario, VehicleModel
from planner.cost.constraints import with_progress
from planner.cost.kernel import INFEASIBLE_KM, evaluate
from planner.cost.problem import PLANNING_MARGINS, Margins, PathProblem, path_problem
from planner.first_paths import box, first_paths
from planner.limits import airspeed_range_m_s, slope_range
from planner.search import minimize
from planner.skein.search import skein_path

FloatArray = npt.NDArray[np.float64]

Report = Callable[[int, int, float], None]
"""Told as a search goes on: evaluations made, how many there may be, and the best cost so far."""
History = tuple[tuple[int, float], ...]
"""Evaluations, and the best cost after so many."""

SKEIN = "skein"
METHODS = (SKEIN, "pso", "qpso", "hybrid", "published")
"""Skein's own, which sees the problem, and those of `planner.search.methods` that see a cost function."""
EVALUATIONS = 3
"""Budgets are population x iterations x this: what the hybrid takes, so that methods compare (MODEL, section 8)."""
SEARCH_STREAM = 1
"""Purpose of the random streams of searches, beside seed, sysid and attempt."""
DETOUR = 1.05
"""How much longer than its line the longest path may become before the slowest aircraft would be too slow."""
CLIMBS = 0.98
"""Part of the steepest climb that a straight line may take for its UAV to be hurried."""
WIDER = 0.5
"""Of the planning margins: what each further attempt adds."""


@dataclass(frozen=True)
class Wish:
    """What one UAV's search is asked for beyond its scenario.

    Attributes:
        attempt: from 0; each has its own chance, and wider margins.
        length_min_m: least length to fly.
    """

    attempt: int = 0
    length_min_m: float = 0.0


NO_WISH = Wish()


@dataclass(frozen=True)
class PathFound:
    """What a search found for one UAV.

    Attributes:
        problem: that it was given.
        corners_m: (m, 3) of the best path.
        cost_km: of that; above `INFEASIBLE_KM` when it breaks a limit.
        evaluations: of the search.
        history: of the search.
    """

    problem: PathProblem
    corners_m: FloatArray
    cost_km: float
    evaluations: int
    history: History

    @property
    def feasible(self) -> bool:
        """Whether the path keeps to all limits that the search knows."""
        return self.cost_km < INFEASIBLE_KM


def find_path(
    scenario: Scenario,
    vehicle: VehicleModel,
    avoided: Sequence[PathFound],
    *,
    method: str,
    seed: int,
    wish: Wish,
    threads: int | None,
    report: Report,
) -> PathFound:
    """Search for a path.

    Args:
        scenario, vehicle: whose path.
        avoided: paths of UAVs to keep the distance from, in time.
        method: one of `METHODS`.
        seed: with the vehicle's sysid and the attempt, all there is of chance.
        wish: beyond the scenario.
        threads: that `skein` may use; all unless given. The others use all.
        report: told of progress: done, of how many, best cost so far.
    """
    settings = scenario.search
    others = [with_progress(path.corners_m, path.problem) for path in avoided]
    problem = vehicle_problem(scenario, vehicle, others, wish)
    budget = settings.population * settings.iterations * EVALUATIONS
    chance = np.random.SeedSequence([seed, SEARCH_STREAM, vehicle.sysid, wish.attempt])
    if method == SKEIN:
        found = skein_path(
            problem,
            settings.waypoints,
            budget=budget,
            seed=int(chance.generate_state(1)[0]),
            threads=threads,
            report=lambda evaluations, best_km: report(evaluations, budget, best_km),
        )
        return PathFound(problem, problem.corners_m(found.x), found.fun, found.nfev, found.history)
    return _swarmed(problem, scenario, method, budget, np.random.default_rng(chance), report)


def _swarmed(
    problem: PathProblem, scenario: Scenario, method: str, budget: int, rng: np.random.Generator, report: Report
) -> PathFound:
    """Search by a method that knows nothing of paths, from smooth bends of the straight line."""
    settings = scenario.search
    share = settings.population * EVALUATIONS
    history: list[tuple[int, float]] = []

    def tell(now: OptimizeResult) -> None:
        if now.nfev % share == 0:
            history.append((now.nfev, now.fun))
            report(now.nfev, budget, now.fun)

    result = minimize(
        lambda population: evaluate(population, problem, settings.reading)[0],
        np.tile(np.column_stack(box(problem)), (settings.waypoints, 1)),
        method=method,
        budget=budget,
        seed=rng,
        x0=first_paths(problem, settings.waypoints, settings.population, rng),
        callback=tell,
    )
    return PathFound(problem, problem.corners_m(result.x), result.fun, result.nfev, tuple(history))


def vehicle_problem(
    scenario: Scenario, vehicle: VehicleModel, others: Sequence[FloatArray] = (), wish: Wish = NO_WISH
) -> PathProblem:
    """What a search for a vehicle's path is given.

    Args:
        others: the paths of UAVs to avoid, from `with_progress`; nobody else in the air unless given.
        wish: beyond the scenario.
    """
    margins = Margins(*(margin * (1.0 + WIDER * wish.attempt) for margin in PLANNING_MARGINS))
    return path_problem(
        scenario,
        vehicle,
        np.array(others, dtype=np.float64).reshape(-1, scenario.search.waypoints + 2, 4),
        _expected_ground_speed_m_s(scenario, vehicle),
        margins,
        wish.length_min_m,
    )


def _expected_ground_speed_m_s(scenario: Scenario, vehicle: VehicleModel) -> float:
    """All arrive together: whoever has the longest line flies at cruise, or faster where the one with the shortest
    would otherwise be too slow and all still climb to their targets; the others as much slower as their lines are
    shorter, but nobody slower than an aircraft can fly: whose line is too short for that will take a longer way.
    """
    ends = {of.sysid: (scenario.origin_m(of), scenario.target_m(of)) for of in scenario.vehicles}
    lines = {sysid: math.dist(start[:2], end[:2]) for sysid, (start, end) in ends.items()}
    longest, shortest = max(lines.values()), min(lines.values())
    slowest, fastest = airspeed_range_m_s(scenario)
    at_longest = scenario.airframe.airspeed_cruise_m_s
    needed = DETOUR * slowest * longest / shortest
    if at_longest < needed <= fastest and all(
        end[2] - start[2] < CLIMBS * lines[sysid] * slope_range(scenario, needed * lines[sysid] / longest)[1]
        for sysid, (start, end) in ends.items()
    ):
        at_longest = needed
    return max(slowest, at_longest * lines[vehicle.sysid] / longest)
