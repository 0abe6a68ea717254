"""A flight of which only the figures are kept."""

import asyncio
import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from gcs.flight import FlightOptions, fly
from gcs.metrics import Metrics, Series, measure
from gcs.run_folder import make_run_folder
from gcs.truth import Truths, read_truths
from gcs.watch import VehicleStatus
from missions.scenario import Scenario
from planner.formation_plan import FormationPlan
from sitl.formation.graph import edges


@dataclass(frozen=True)
class Flown:
    """What a flight came to: where everyone was, figures of merit, and what they are over time."""

    truths: Truths
    metrics: Metrics
    series: Series


def fly_for_the_record(scenario: Scenario, plan: FormationPlan, announce: Callable[[str], None]) -> Flown:
    """Fly a plan on simulated endpoints, with the scenario's delay.

    Raises:
        InputError, TransferError: as `gcs.flight.fly` does, or a vehicle was lost before it had recorded anything.
    """

    def show_nothing(statuses: list[VehicleStatus]) -> None:
        pass

    sysids = [uav.sysid for uav in plan.uavs]
    with tempfile.TemporaryDirectory() as folder:
        run = make_run_folder(Path(folder) / scenario.name, scenario.name)
        options = FlightOptions(delay_s=scenario.formation.delay_s)
        record = asyncio.run(fly(scenario, plan, run, options, announce, show_nothing))
        truths = read_truths(run.truth, sysids)
    metrics, series = measure(scenario, plan, truths, edges(scenario.formation.graph, sysids), record)
    return Flown(truths, metrics, series)
