"""The search for one UAV's path."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from scipy.optimize import OptimizeResult

from missions.errors import InputError
from missions.scenario import Scenario, VehicleModel
from planner.cost.constraints import with_progress
from planner.cost.kernel import INFEASIBLE_KM, Reading, evaluate
from planner.cost.problem import PLANNING_MARGINS, PathProblem, path_problem
from planner.first_paths import box, first_paths
from planner.limits import airspeed_range_m_s
from planner.search import minimize

FloatArray = npt.NDArray[np.float64]
Report = Callable[[int, int, float], None]
"""Told as a search goes on: iterations done, how many there are, and the best cost so far."""

SEARCHES = ("pso", "qpso", "hybrid", "published")
"""Those of `planner.search.methods` that search for paths."""
EVALUATIONS = 3
"""A particle an iteration: what the hybrid takes. Others make more of their own steps in an iteration, so that methods
compare (MODEL, section 8)."""
SEARCH_STREAM = 1
"""Purpose of the random streams of searches, beside seed, sysid and attempt."""
DETOUR = 1.05
"""How much longer than its line the longest path may become before the slowest aircraft would be too slow."""


@dataclass(frozen=True)
class PathFound:
    """What a search found for one UAV.

    Attributes:
        problem: that it was given.
        corners_m: (m, 3) of the best path.
        cost_km: of that; above `INFEASIBLE_KM` when it breaks a limit.
        evaluations: of the search.
        history: best cost after each iteration.
    """

    problem: PathProblem
    corners_m: FloatArray
    cost_km: float
    evaluations: int
    history: tuple[float, ...]

    @property
    def feasible(self) -> bool:
        """Whether the path keeps to all limits that the search knows."""
        return self.cost_km < INFEASIBLE_KM


def find_path(
    scenario: Scenario,
    vehicle: VehicleModel,
    earlier: Sequence[PathFound],
    *,
    method: str,
    seed: int,
    attempt: int,
    report: Report,
) -> PathFound:
    """Search for a path that avoids those of earlier UAVs in time.

    Args:
        scenario, vehicle: whose path.
        earlier: paths of the UAVs that go before.
        method: one of `SEARCHES`.
        seed, attempt: with the vehicle's sysid, all there is of chance.
        report: told of every iteration.
    """
    settings = scenario.search
    others = [with_progress(path.corners_m, path.problem) for path in earlier]
    problem = path_problem(
        scenario,
        vehicle,
        np.array(others, dtype=np.float64).reshape(-1, settings.waypoints + 2, 4),
        _expected_ground_speed_m_s(scenario, vehicle),
        PLANNING_MARGINS,
    )
    rng = np.random.default_rng(np.random.SeedSequence([seed, SEARCH_STREAM, vehicle.sysid, attempt]))
    reading: Reading = settings.reading
    low, high = box(problem)
    share = settings.population * EVALUATIONS

    def tell(now: OptimizeResult) -> None:
        if now.nfev % share == 0:
            report(now.nfev // share, settings.iterations, now.fun)

    result = minimize(
        lambda population: evaluate(population, problem, reading)[0],
        np.tile(np.column_stack([low, high]), (settings.waypoints, 1)),
        method=method,
        budget=share * settings.iterations,
        seed=rng,
        x0=first_paths(problem, settings.waypoints, settings.population, rng),
        callback=tell,
    )
    return PathFound(problem, problem.corners_m(result.x), result.fun, result.nfev, _after_each(share, result.history))


def _after_each(share: int, history: FloatArray) -> tuple[float, ...]:
    """Best cost after each `share` of evaluations, from that after each batch."""
    evaluations, best = history.T
    ends = np.arange(share, evaluations[-1] + 1, share)
    return tuple(best[np.searchsorted(evaluations, ends, side="right") - 1].tolist())


def require_feasible(name: str, path: PathFound, attempts: int) -> None:
    """Raise InputError, with what stands in the way, when no search found a feasible path."""
    if path.feasible:
        return
    bounds = path.problem.bounds
    _, terms = evaluate(path.corners_m[1:-1].reshape(1, -1), path.problem, "published")
    if terms[0, 1] == bounds.terrain_penalty_km:
        why = "still goes through the ground"
    elif terms[0, 3] > 0.0:
        why = "still comes too close to an obstacle or to an earlier UAV"
    else:
        why = "still breaks a limit of clearance, area, leg length, turn or climb"
    slope = float(path.problem.target_m[2] - path.problem.origin_m[2]) / float(
        np.hypot(*(path.problem.target_m - path.problem.origin_m)[:2])
    )
    raise InputError(
        f"{name}: no feasible path in {attempts} searches of {path.evaluations} evaluations: the best {why} "
        f"(straight to the target is a slope of {slope:.3f}, at most {bounds.slope_max:.3f} is flown); "
        "move its target, loosen limits, or raise search.iterations"
    )


def _expected_ground_speed_m_s(scenario: Scenario, vehicle: VehicleModel) -> float:
    """All arrive together: whoever has the longest line flies at cruise, or faster where the one with the shortest
    would otherwise be too slow; the others as much slower as their lines are shorter.

    Where even the fastest would not do, at cruise all the same: the schedule then says whose line is too short.
    """
    lines = {of.sysid: math.dist(scenario.target_m(of)[:2], scenario.origin_m(of)[:2]) for of in scenario.vehicles}
    longest, shortest = max(lines.values()), min(lines.values())
    slowest, fastest = airspeed_range_m_s(scenario)
    cruise = scenario.airframe.airspeed_cruise_m_s
    needed = DETOUR * slowest * longest / shortest
    return max(cruise, needed if needed <= fastest else cruise) * lines[vehicle.sysid] / longest
