"""All vehicles of a scenario together: what their plans cost in all, seed by seed, and how long planning takes."""

import hashlib
import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from missions.errors import InputError
from missions.scenario import Scenario
from planner.bench.best_known import BestKnown, BestPlan, found_now
from planner.bench.comparison import TARGETS, finite
from planner.bench.digest import problem_digest
from planner.bench.measures import gap, quartiles
from planner.cost.constraints import with_progress
from planner.cost.kernel import INFEASIBLE_KM, evaluate
from planner.find_path import vehicle_problem
from planner.formation_plan import FormationPlan
from planner.plan import plan

FloatArray = npt.NDArray[np.float64]


def plan_digest(scenario: Scenario) -> str:
    """16 hexadecimal digits of a scenario without slots, over all that its vehicles' paths depend on."""
    digest = hashlib.sha256(f"{scenario.limits.separation_m:g}".encode())
    for vehicle in scenario.vehicles:
        digest.update(problem_digest(vehicle_problem(scenario, vehicle), scenario.search.waypoints).encode())
    return digest.hexdigest()[:16]


def total_km(scenario: Scenario, interiors_m: Sequence[Any]) -> float:
    """Sum of f over the paths of all vehicles, in order of priority; above `INFEASIBLE_KM` when one breaks a limit.

    Args:
        interiors_m: of each vehicle, (3 waypoints,) metres. Each must avoid the earlier ones in time.
    """
    total = 0.0
    others: list[FloatArray] = []
    for vehicle, interior in zip(scenario.vehicles, interiors_m, strict=True):
        problem = vehicle_problem(scenario, vehicle, others)
        flat = np.asarray(interior, dtype=np.float64).reshape(1, -1)
        total += float(evaluate(flat, problem, "graded")[0][0])
        others.append(with_progress(problem.corners_m(flat), problem))
    return total


@dataclass(frozen=True)
class PlanRun:
    """One plan of all vehicles.

    Attributes:
        scenario, method, seed: which.
        total_km: sum of all vehicles' f; infinite without a verified plan.
        plan_s: wall time of planning, all cores, without compilation.
        plan: the plan; None without one.
        reason: why there is none.
    """

    scenario: str
    method: str
    seed: int
    total_km: float
    plan_s: float
    plan: FormationPlan | None
    reason: str = ""


def plan_run(scenario: Scenario, method: str, seed: int) -> PlanRun:
    """Plan all vehicles once."""
    try:
        made = plan(scenario, seed=seed, method=method)
    except InputError as error:
        return PlanRun(scenario.name, method, seed, math.inf, 0.0, None, str(error))
    total = sum(uav.terms.fitness for uav in made.uavs)
    return PlanRun(scenario.name, method, seed, total, made.plan_s, made)


def plan_figures(runs: Sequence[PlanRun], best_known_km: float | None) -> dict[str, Any]:
    """What the runs of one scenario and method say, against the best-known total or what was found here."""
    best = min([run.total_km for run in runs] + ([] if best_known_km is None else [best_known_km]))
    gaps = [gap(run.total_km, best) if run.plan else math.inf for run in runs]
    times = [run.plan_s for run in runs if run.plan]
    return {
        "scenario": runs[0].scenario,
        "method": runs[0].method,
        "best_known_km": best_known_km,
        "best_km": finite(best),
        "runs": len(runs),
        "gap": dict(zip(("q1", "median", "q3"), map(finite, quartiles(gaps)), strict=True)),
        "success_rate": {f"within_{target:g}": float(np.mean(np.array(gaps) <= target)) for target in TARGETS},
        "plan_s": dict(zip(("q1", "median", "q3"), quartiles(times), strict=True)) if times else None,
        "seeds": [
            {"seed": run.seed, "total_km": finite(run.total_km), "plan_s": run.plan_s, "reason": run.reason}
            for run in runs
        ],
    }


def offer_plan(known: BestKnown, scenario: Scenario, made: FormationPlan) -> bool:
    """Keep a plan if it is feasible, margins included, and better than what is known; says whether it was."""
    return _offer(known, scenario, [uav.waypoints_m[1:-1].reshape(-1) for uav in made.uavs], made.method, made.seed)


def offer_best_paths(known: BestKnown, scenario: Scenario) -> bool:
    """Keep the best-known paths of all vehicles alone as a plan of all, if they keep their distances and are better;
    says whether it was."""
    digests = [
        problem_digest(vehicle_problem(scenario, vehicle), scenario.search.waypoints) for vehicle in scenario.vehicles
    ]
    if any(digest not in known.paths for digest in digests):
        return False
    best = [known.paths[digest] for digest in digests]
    method = ", ".join(dict.fromkeys(entry.method for entry in best)) + ", each alone"
    return _offer(known, scenario, [np.array(entry.path_m) for entry in best], method, best[0].seed)


def _offer(known: BestKnown, scenario: Scenario, paths_m: Sequence[FloatArray], method: str, seed: int) -> bool:
    digest, value = plan_digest(scenario), total_km(scenario, paths_m)
    best = known.value_km(digest)
    if value >= INFEASIBLE_KM or (best is not None and value >= best):
        return False
    known.plans = {other: entry for other, entry in known.plans.items() if entry.scenario != scenario.name}
    known.plans[digest] = BestPlan(
        scenario=scenario.name,
        digest=digest,
        value_km=value,
        method=method,
        seed=seed,
        found=found_now(),
        paths_m=tuple(tuple(path.tolist()) for path in paths_m),
    )
    return True
