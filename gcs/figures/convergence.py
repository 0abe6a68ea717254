"""How the searches for the paths converged."""

from pathlib import Path

import numpy as np

from gcs.figures import style
from missions.scenario import Scenario
from planner.formation_plan import FormationPlan


def draw_convergence(plan: FormationPlan, scenario: Scenario, path: Path) -> None:
    """Draw the best feasible cost of each UAV over evaluations, in lengths of its straight line."""
    colours = style.vehicle_colours(scenario)
    with style.page(path, 4.4) as figure:
        axes = figure.subplots()
        for uav in plan.uavs:
            evaluations, costs_km = np.array(uav.history, dtype=np.float64).T
            axes.step(evaluations, costs_km * 1000.0 / uav.straight_line_m, where="post", color=colours[uav.sysid])
        axes.set_title("Best feasible cost so far; 1 is the straight line, which no path can beat")
        axes.set_xlabel("evaluations of the objective")
        axes.set_ylabel("f / straight line (km / km)")
        axes.set_xlim(0.0, max(uav.evaluations for uav in plan.uavs))
        axes.set_ylim(bottom=1.0)
        style.headline(figure, f"{scenario.name}: the search, {plan.method}, seed {plan.seed}")
        style.legend_beside(figure, style.vehicle_handles(scenario))
