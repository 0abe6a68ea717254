"""One flight of a campaign: small to send, the same wherever it is flown."""

import pickle
from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import cast

import missions
from gcs.campaign.axes import ARM, Value, with_values
from gcs.metrics import Planned, measure, shortfalls, what_was_planned
from gcs.rehearsal import RehearsalOptions, rehearse_plan
from missions.compiled import sources_hash
from missions.scenario import Scenario
from planner.formation_plan import FormationPlan
from sitl.config import Arm
from sitl.formation.graph import edges


@dataclass(frozen=True)
class Case:
    """Which flight.

    Attributes:
        values: of the campaign's axes, (key, value).
        seed: of the gusts.
    """

    values: tuple[tuple[str, Value], ...]
    seed: int


@dataclass(frozen=True)
class Outcome:
    """What came of a flight; None where it is not defined (see `FormationMetrics`).

    Attributes:
        arrived: how many vehicles did.
        shortfalls: how many things fell short, as `skein rehearse` would list them.
    """

    arrived: int
    rms_error_m: float | None
    max_error_m: float | None
    arrival_spread_s: float | None
    min_separation_m: float | None
    min_clearance_m: float | None
    clearance_margin_m: float | None
    min_wall_m: float | None
    shortfalls: int
    trajectory_sha256: str | None


@dataclass(frozen=True)
class Flown:
    """A case, and what came of it."""

    case: Case
    outcome: Outcome


@dataclass(frozen=True)
class Course:
    """What all flights of a campaign share, as it is sent to other processes.

    Attributes:
        sources: a name for the state of all sources here; a process with others refuses.
        data: scenario and plan, pickled.
    """

    sources: str
    data: bytes

    def fly(self, case: Case) -> Flown:
        """Fly one case.

        Raises:
            RuntimeError: this process has another version of the sources.
        """
        if self.sources != own_sources():
            raise RuntimeError(f"sources {own_sources()} here, not {self.sources}: another version of skein?")
        scenario, plan, planned = _opened(self.data)
        return Flown(case, fly_case(scenario, plan, planned, case))


def make_course(scenario: Scenario, plan: FormationPlan) -> Course:
    """What is sent."""
    return Course(own_sources(), pickle.dumps((scenario, plan)))


@lru_cache(maxsize=1)
def own_sources() -> str:
    """A name for the state of all sources of this process."""
    return sources_hash(Path(missions.__file__).parents[1])


@lru_cache(maxsize=1)
def _opened(data: bytes) -> tuple[Scenario, FormationPlan, Planned]:
    scenario, plan = pickle.loads(data)
    return scenario, plan, what_was_planned(scenario, plan)


def fly_case(scenario: Scenario, plan: FormationPlan, planned: Planned, case: Case) -> Outcome:
    """Rehearse and measure one case."""
    values: Mapping[str, Value] = dict(case.values)
    scenario = with_values(scenario, values)
    options = RehearsalOptions(case.seed, scenario.formation.delay_s, cast(Arm, values.get(ARM, "full")))
    truths, record = rehearse_plan(scenario, plan, options)
    graph = edges(scenario.formation.graph, [uav.sysid for uav in plan.uavs])
    metrics, _ = measure(scenario, plan, truths, graph, record, planned)
    formation = metrics.formation
    return Outcome(
        arrived=sum(vehicle.completed for vehicle in metrics.vehicles),
        rms_error_m=formation.rms_error_m,
        max_error_m=formation.max_error_m,
        arrival_spread_s=formation.arrival_spread_s,
        min_separation_m=formation.min_separation_m,
        min_clearance_m=formation.min_clearance_m,
        clearance_margin_m=formation.clearance_margin_m,
        min_wall_m=formation.min_wall_m,
        shortfalls=len(shortfalls(metrics, scenario)),
        trajectory_sha256=metrics.trajectory_sha256,
    )
