"""What flights of a plan are measured against: computed once, the same for any number of them."""

from collections.abc import Mapping
from dataclasses import dataclass

from gcs.metrics.tracks import Tracks, planned_tracks
from missions.reference import Reference
from missions.scenario import Scenario
from planner.formation_plan import FormationPlan


@dataclass(frozen=True)
class Planned:
    """A plan as its flights are compared with it.

    Attributes:
        references: what each vehicle is to fly, by sysid.
        tracks: where it is then; nothing is flown yet.
    """

    references: Mapping[int, Reference]
    tracks: Tracks


def what_was_planned(scenario: Scenario, plan: FormationPlan) -> Planned:
    """Build it from the missions, as endpoints build what they fly."""
    references = plan.references(scenario)
    return Planned(references, planned_tracks(references))
