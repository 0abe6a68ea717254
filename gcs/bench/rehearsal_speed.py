"""How fast a swarm is rehearsed on one core, and beside it, in the same run, how fast its endpoints fly."""

import asyncio
import statistics
import tempfile
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from gcs.flight import FlightOptions, fly
from gcs.rehearsal import RehearsalOptions, compile_rehearsal, rehearse_plan
from gcs.report import report_on
from gcs.run_folder import make_run_folder
from gcs.truth import read_truths
from gcs.watch import VehicleStatus
from missions.scenario import Scenario
from planner.formation_plan import FormationPlan


@dataclass(frozen=True)
class RehearsalSpeed:
    """One plan, rehearsed again and again, and flown by endpoints once.

    Attributes:
        scenario: its name.
        vehicles: how many.
        compile_s: wall time until the rehearsal was compiled, or read from the cache; in no other figure.
        rehearsal_sim_s: simulated.
        rehearsal_cpu_s: CPU seconds of the only thread, the least of all runs: draws of gusts and what the missions
            are made into included.
        rehearsal_median_cpu_s: their median.
        rehearsal_factor: rehearsal_sim_s / rehearsal_cpu_s, times real time on one core.
        flight_wall_s, flight_factor: of the endpoints' flight, a process each, on all cores, once the clock was
            released.
        same_trajectory: whether both flew the same, bit for bit.
    """

    scenario: str
    vehicles: int
    compile_s: float
    rehearsal_sim_s: float
    rehearsal_cpu_s: float
    rehearsal_median_cpu_s: float
    rehearsal_factor: float
    flight_wall_s: float
    flight_factor: float
    same_trajectory: bool


def measure_rehearsal(
    scenario: Scenario, plan: FormationPlan, runs: int, announce: Callable[[str], None]
) -> RehearsalSpeed:
    """Rehearse a plan so many times, and fly it.

    Raises:
        InputError, TransferError: as `gcs.flight.fly`.
    """
    options = RehearsalOptions(plan.seed, scenario.formation.delay_s)
    announce("Compiling, rehearsing")
    compile_s = compile_rehearsal(scenario, plan)
    cpu_s = []
    for _ in range(runs):
        began = time.thread_time()
        truths, record = rehearse_plan(scenario, plan, options)
        cpu_s.append(time.thread_time() - began)
    rehearsed = report_on(scenario, plan, truths, record).metrics
    with tempfile.TemporaryDirectory() as folder:
        run = make_run_folder(Path(folder) / scenario.name, scenario.name)
        flight_record = asyncio.run(fly(scenario, plan, run, FlightOptions(options.delay_s), announce, _show_nothing))
        flown_truths = read_truths(run.truth, plan.missions)
        flown = report_on(scenario, plan, flown_truths, flight_record).metrics
    sim_s = record.timing.flight_sim_s
    return RehearsalSpeed(
        scenario=scenario.name,
        vehicles=len(plan.uavs),
        compile_s=compile_s,
        rehearsal_sim_s=sim_s,
        rehearsal_cpu_s=min(cpu_s),
        rehearsal_median_cpu_s=statistics.median(cpu_s),
        rehearsal_factor=sim_s / min(cpu_s),
        flight_wall_s=flight_record.timing.flight_wall_s,
        flight_factor=flight_record.timing.real_time_factor,
        same_trajectory=rehearsed["trajectory_sha256"] == flown["trajectory_sha256"],
    )


def _show_nothing(statuses: list[VehicleStatus]) -> None:
    pass
