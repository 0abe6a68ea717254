"""How a plan stands: against what no path can beat, and against the best that anyone has found."""

from dataclasses import dataclass

import numpy as np

from missions.scenario import Scenario
from planner.bench.best_known import best_known
from planner.bench.digest import problem_digest
from planner.bench.together import plan_digest
from planner.cost.lower_bound import lower_bound_km
from planner.find_path import vehicle_problem
from planner.formation_plan import FormationPlan


@dataclass(frozen=True)
class Standing:
    """How one UAV's path stands, or all together.

    Attributes:
        fitness_km: f of (3).
        lower_bound_km: that no path can cost less than, others' conflicts aside.
        best_known_km: the best-known cost, of the UAV alone or of all together; None where none is kept.
    """

    fitness_km: float
    lower_bound_km: float
    best_known_km: float | None

    @property
    def gap(self) -> float | None:
        """Fitness over best-known, less 1; None where none is kept."""
        return None if self.best_known_km is None else self.fitness_km / self.best_known_km - 1.0


def standings(plan: FormationPlan, scenario: Scenario) -> tuple[list[Standing], Standing]:
    """Of each UAV in the plan's order, and of all together. Slots have no best-knowns: they are not searched for."""
    vehicles = {vehicle.sysid: vehicle for vehicle in scenario.vehicles}
    alone = []
    for uav in plan.uavs:
        problem, waypoints = vehicle_problem(scenario, vehicles[uav.sysid]), len(uav.waypoints_m) - 2
        known = None if scenario.route else best_known(problem_digest(problem, waypoints))
        alone.append(Standing(uav.terms.fitness, lower_bound_km(problem, waypoints), known))
    total = Standing(
        float(np.sum([standing.fitness_km for standing in alone])),
        float(np.sum([standing.lower_bound_km for standing in alone])),
        None if scenario.route else best_known(plan_digest(scenario)),
    )
    return alone, total
