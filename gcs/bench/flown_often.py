"""Shipped scenarios rehearsed with hundreds of random failures, and with a thousand seeds of gusts in each arm."""

import os

from gcs.rehearsal import compile_rehearsal
from gcs.study.arms import Worth, arm_trials, worth
from gcs.study.fault_campaign import FaultCampaign, fly_faults
from gcs.study.fly import fly_trials
from missions.scenario import Scenario, load_scenario
from planner.formation_plan import FormationPlan
from planner.jobs.processes import Processes
from planner.plan import plan
from planner.verify import require, verify

FAULTY = ("radars", "mountains", "vee", "crossing")
SCHEDULES = 200
IN_GUSTS = ("vee", "crossing")
GUSTS = "moderate"
SEEDS = 1000


def measure_faults(schedules: int = SCHEDULES) -> list[FaultCampaign]:
    """Random failures in each scenario."""
    return [
        fly_faults(scenario, planned, range(1, schedules + 1), _all_cores())
        for scenario, planned in (_planned(name) for name in FAULTY)
    ]


def measure_arms(seeds: int = SEEDS) -> list[Worth]:
    """All three arms in moderate gusts."""
    found = []
    for scenario, planned in (_planned(name) for name in IN_GUSTS):
        trials = arm_trials(scenario, GUSTS, range(1, seeds + 1))
        found.append(worth(scenario, fly_trials(scenario, planned, trials, _all_cores())))
    return found


def _planned(name: str) -> tuple[Scenario, FormationPlan]:
    scenario = load_scenario(name)
    found = plan(scenario)
    require(verify(found, scenario))
    compile_rehearsal(scenario, found)
    return scenario, found


def _all_cores() -> Processes:
    return Processes(os.cpu_count() or 1)
