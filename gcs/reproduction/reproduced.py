"""One scenario of the paper, done again."""

from dataclasses import dataclass

from gcs.reproduction.flown import Flown
from missions.scenario import Scenario
from planner.formation_plan import FormationPlan
from planner.reproduction import Study


@dataclass(frozen=True)
class Reproduced:
    """What was made of one scenario.

    Attributes:
        scenario: as the paper has it, MODEL section 8 where it says nothing.
        hybrid, skein: verified plans of all UAVs together, by the paper's method and by Skein's.
        flown: the hybrid's plan in the air; None when it was not flown.
        study: how the methods compare, each UAV alone in the air.
    """

    scenario: Scenario
    hybrid: FormationPlan
    skein: FormationPlan
    flown: Flown | None
    study: Study
