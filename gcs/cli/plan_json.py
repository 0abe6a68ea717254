"""What `skein plan --json` prints: the plan, how it stands, and what the verifier says of it."""

import math
from dataclasses import asdict
from typing import Any

from missions.scenario import Scenario
from planner.formation_plan import FormationPlan
from planner.standing import Standing, standings
from planner.verify import verify


def plan_json(plan: FormationPlan, scenario: Scenario) -> dict[str, Any]:
    """plan.json with, for each UAV and for all together, lower bound, best-known and gap; and what the verifier found."""
    alone, together = standings(plan, scenario)
    report = verify(plan, scenario)
    values = plan.as_json()
    for uav, standing, verified in zip(values["uavs"], alone, report.uavs, strict=True):
        uav |= _standing(standing)
        uav["verified"] = uav["sysid"] not in report.at_fault
        uav["verification"] = {
            key: None if isinstance(value, float) and not math.isfinite(value) else value
            for key, value in asdict(verified).items()
            if key not in ("sysid", "name")
        }
    return {
        **values,
        "fitness": together.fitness_km,
        **_standing(together),
        "verified": not report.violations,
    }


def _standing(standing: Standing) -> dict[str, float | None]:
    return {
        "lower_bound": standing.lower_bound_km,
        "best_known": standing.best_known_km,
        "gap": standing.gap,
    }
