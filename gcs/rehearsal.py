"""A plan rehearsed: flown by the whole swarm in this process, as `gcs.flight` flies it with endpoints, bit for bit."""

import time
from dataclasses import dataclass, replace

from gcs.delay_margin import delay_margin_s
from gcs.flight_record import Event, FlightRecord, Timing
from gcs.truth import Truths
from missions.scenario import Scenario
from planner.formation_plan import FormationPlan
from planner.reassign import reassigner_of
from sitl.config import Arm
from sitl.crew import KILLED
from sitl.formation.network import complete
from sitl.places import what_losses_lead_to
from sitl.rehearsal import rehearse
from sitl.swarm import SwarmOptions, vehicle_configs
from sitl.ticks import TICK_S, delay_ticks


@dataclass(frozen=True)
class RehearsalOptions:
    """How a plan is rehearsed.

    Attributes:
        seed: of the gusts.
        delay_s: of the corrections; rounded up to whole ticks.
        arm: how much of the formation law is on.
    """

    seed: int
    delay_s: float
    arm: Arm = "full"


def compile_rehearsal(scenario: Scenario, plan: FormationPlan) -> float:
    """Have the rehearsal compiled, or read from the cache, by the flight of one vehicle; returns how long it took,
    seconds.

    Raises:
        InputError: as `rehearse_plan`.
    """
    began = time.monotonic()
    first, *_ = vehicle_configs(scenario, SwarmOptions(plan.seed, 0.0))
    rehearse([replace(first, network=complete([first.sysid], (), 1))], plan.missions)
    return time.monotonic() - began


def rehearse_plan(
    scenario: Scenario, plan: FormationPlan, options: RehearsalOptions, compile_s: float = 0.0
) -> tuple[Truths, FlightRecord]:
    """Fly a plan that verifies; returns what endpoints would have recorded, and what else became of the flight.

    Args:
        scenario, plan: what is flown.
        options: how.
        compile_s: that compiling took before.

    Raises:
        InputError: a mission is not what a rehearsal flies.
    """
    reassign = reassigner_of(scenario, plan)
    vehicles = vehicle_configs(scenario, SwarmOptions(options.seed, options.delay_s, options.arm, reassign=reassign))
    began = time.monotonic()
    flown = rehearse(vehicles, plan.missions)
    wall_s = time.monotonic() - began
    sim_s = max(map(len, flown.truth.values())) * TICK_S
    lost = {i: tick * TICK_S for i, tick in vehicles[0].network.deaths.items() if len(flown.truth[i]) == tick}
    record = FlightRecord(
        seed=options.seed,
        delay_s=delay_ticks(options.delay_s) * TICK_S,
        arm=options.arm,
        items_uploaded={},
        items_verified={},
        timing=Timing(
            compile_s=plan.compile_s + compile_s,
            plan_s=plan.plan_s,
            startup_s=None,
            upload_s=None,
            flight_wall_s=wall_s,
            flight_sim_s=sim_s,
            real_time_factor=sim_s / wall_s,
        ),
        events=tuple(Event(t_s, sysid, f"lost: vehicle {sysid}: {KILLED}") for sysid, t_s in lost.items()),
        lost=lost,
        delay_margin_s=delay_margin_s(scenario),
        edges=tuple(flown.edges),
        shifts=flown.shifts,
        yieldings=flown.yieldings,
        reassigned=what_losses_lead_to(vehicles[0]),
    )
    return flown.truth, record
