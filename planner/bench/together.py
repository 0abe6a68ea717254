"""All vehicles of a scenario together: what their paths cost in all, checked one after the other in time."""

import hashlib
from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from missions.scenario import Scenario
from planner.bench.best_known import BestKnown, BestPlan, found_now
from planner.bench.digest import problem_digest
from planner.cost.constraints import with_progress
from planner.cost.kernel import INFEASIBLE_KM, evaluate
from planner.find_path import vehicle_problem
from planner.formation_plan import FormationPlan

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


def offer_plan(known: BestKnown, scenario: Scenario, plan: FormationPlan) -> bool:
    """Keep a plan if it is feasible, margins included, and better than what is known; says whether it was."""
    paths = [uav.waypoints_m[1:-1].reshape(-1) for uav in plan.uavs]
    digest, value = plan_digest(scenario), total_km(scenario, paths)
    best = known.value_km(digest)
    if value >= INFEASIBLE_KM or (best is not None and value >= best):
        return False
    known.plans[digest] = BestPlan(
        scenario=scenario.name,
        digest=digest,
        value_km=value,
        method=plan.method,
        seed=plan.seed,
        found=found_now(),
        paths_m=tuple(tuple(path.tolist()) for path in paths),
    )
    return True
