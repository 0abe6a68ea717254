"""Closing the gap that a lost vehicle leaves: which places are kept, who takes which, when, and whether it is safe."""

from missions.scenario import Scenario
from planner.formation_plan import FormationPlan
from planner.reassign.reassigner import Reassigner

__all__ = ["Reassigner", "reassigner_of"]


def reassigner_of(scenario: Scenario, plan: FormationPlan) -> Reassigner | None:
    """Finds what losses lead to; None where the scenario wants no reassignment."""
    return Reassigner(scenario, plan) if scenario.formation.reassign else None
