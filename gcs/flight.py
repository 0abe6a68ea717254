"""Flying a plan on simulated endpoints: launch, upload, verify, arm, release, watch, end."""

import asyncio
import contextlib
import math
import time
from collections.abc import Awaitable, Callable, Coroutine, Sequence
from dataclasses import dataclass, field
from functools import partial
from typing import Any, TypeVar

import zenoh

from gcs.delay_margin import delay_margin_s
from gcs.fleet import Fleet
from gcs.flight_record import Event, FlightRecord, Timing
from gcs.links.udp import UdpLink
from gcs.run_folder import RunFolder
from gcs.swarm_clock import SwarmClock
from gcs.tlog import TelemetryLog
from gcs.transfers.command import arm, set_mode
from gcs.transfers.plans import upload_and_verify
from gcs.vehicle_link import VehicleLink
from gcs.watch import Announce, Display, VehicleStatus, watch_flight
from missions.errors import InputError
from missions.plan_type import PlanType
from missions.scenario import Scenario
from planner.formation_plan import FormationPlan
from planner.reassign import reassigner_of
from planner.verify import require, verify
from sitl.config import Arm
from sitl.formation.swarm_clock import longest_s
from sitl.modes import Mode
from sitl.places import what_losses_lead_to
from sitl.reports import Ended
from sitl.services.links import LOOPBACK
from sitl.swarm import Swarm, SwarmOptions, vehicle_configs
from sitl.ticks import TICK_S, delay_ticks
from sitl.zenoh_session import open_session

HEARTBEAT_TIMEOUT_S = 30.0
LOSS_PERIOD_S = 0.1
"""How often the endpoints are looked after during set-up."""

Result = TypeVar("Result")


@dataclass(frozen=True)
class FlightOptions:
    """How a plan is flown.

    Attributes:
        delay_s: of the corrections; rounded up to whole ticks.
        arm: how much of the formation law is on.
        speed: factor of simulated time; infinite for as fast as it goes.
        real_time: the clock is the wall's, and nobody waits for anybody; in lockstep otherwise.
        per_process: vehicles that share a process; None chooses.
    """

    delay_s: float
    arm: Arm = "full"
    speed: float = math.inf
    real_time: bool = False
    per_process: int | None = None


@dataclass(frozen=True)
class Cockpit:
    """What a flight is steered by.

    Attributes:
        swarm, fleet: the endpoints, and how the station reaches them.
        clock: theirs.
        session: on their network.
        statuses: what the station knows of each vehicle, kept up to date.
        interventions: what is done to the flight, for its record; whoever steers adds to it.
    """

    swarm: Swarm
    fleet: Fleet
    clock: SwarmClock
    session: zenoh.Session
    statuses: Sequence[VehicleStatus]
    interventions: list[Event] = field(default_factory=list)


Steer = Callable[[Cockpit], Awaitable[None]]
"""Called when the clocks have been released; the flight lasts until it returns."""


async def fly(
    scenario: Scenario,
    plan: FormationPlan,
    run: RunFolder,
    options: FlightOptions,
    announce: Announce,
    display: Display,
    steer: Steer | None = None,
) -> FlightRecord:
    """Fly a plan on the scenario's simulated vehicles; truth and logs go to the run's folder.

    Args:
        scenario, plan: what to fly.
        run: where it is kept.
        options: how it is flown.
        announce, display: for people.
        steer: who steers the flight; None for nobody: it ends when all have arrived.

    Raises:
        InputError: the plan does not verify, or an endpoint cannot start or be reached.
        TransferError: a mission could not be brought to a vehicle.
    """
    require(verify(plan, scenario))
    sysids = [uav.sysid for uav in plan.uavs]
    start_s = time.time()
    async with contextlib.AsyncExitStack() as stack:
        stack.enter_context(run.flying())
        fleet = await stack.enter_async_context(Fleet(lambda sysid: TelemetryLog(run.logs / f"{sysid}.tlog", start_s)))
        link = await UdpLink.open()
        fleet.attach(link)

        announce(f"Launching {len(sysids)} endpoints")
        began = time.monotonic()
        how = _swarm_options(scenario, plan, run, options, link.port)
        first, *_ = vehicle_configs(scenario, how)
        what_losses_lead_to(first)  # found once, before vehicles are copied, of the losses that are scheduled
        swarm = stack.enter_context(Swarm(scenario, how))
        vehicles = await fleet.wait_for(sysids, HEARTBEAT_TIMEOUT_S)
        startup_s = time.monotonic() - began
        run.write_json("endpoints.json", _addresses(swarm, link.port))

        announce("Uploading missions and reading them back")
        began = time.monotonic()
        uploads = [
            upload_and_verify(vehicle, PlanType.MISSION, uav.mission)
            for vehicle, uav in zip(vehicles, plan.uavs, strict=True)
        ]
        verified = await _unless_lost(swarm, *uploads)
        upload_s = time.monotonic() - began

        announce("Arming, AUTO")
        await _unless_lost(swarm, *(_arm_in_auto(vehicle) for vehicle in vehicles))

        announce("Releasing the clock")
        began = time.monotonic()
        events, lost = await _fly_held(scenario, plan, swarm, fleet, display, announce, options.real_time, steer)
        flight_wall_s = time.monotonic() - began

    for line in fleet.complaints():
        announce(line)
    last = [endpoint.last for endpoint in swarm.endpoints.values() if endpoint.last is not None]
    ends = [report for report in last if isinstance(report, Ended)]
    unforeseen = max((end.losses for end in ends), key=lambda losses: len(losses), default=())
    flight_sim_s = max(vehicle.simulated_ms for vehicle in vehicles) / 1000.0
    return FlightRecord(
        seed=plan.seed,
        delay_s=delay_ticks(options.delay_s) * TICK_S,
        arm=options.arm,
        items_uploaded={uav.sysid: len(uav.mission) for uav in plan.uavs},
        items_verified=dict(zip(sysids, verified, strict=True)),
        timing=Timing(
            compile_s=plan.compile_s,
            plan_s=plan.plan_s,
            startup_s=startup_s,
            upload_s=upload_s,
            flight_wall_s=flight_wall_s,
            flight_sim_s=flight_sim_s,
            real_time_factor=flight_sim_s / flight_wall_s,
        ),
        events=tuple(events),
        lost=lost,
        delay_margin_s=delay_margin_s(scenario),
        links=tuple(link for end in ends for link in end.links),
        real_time=options.real_time,
        behind_s=max((end.behind_s for end in ends), default=0.0),
        edges=tuple((tick, other, end.sysid, used) for end in last for tick, other, used in end.edges),
        yieldings={end.sysid: end.yieldings for end in last},
        reassigned=what_losses_lead_to(first, unforeseen),
        losses=unforeseen,
    )


def _swarm_options(
    scenario: Scenario, plan: FormationPlan, run: RunFolder, options: FlightOptions, port: int
) -> SwarmOptions:
    return SwarmOptions(
        seed=plan.seed,
        delay_s=options.delay_s,
        arm=options.arm,
        speed=options.speed,
        real_time=options.real_time,
        stations=((LOOPBACK, port),),
        truth=run.truth,
        per_process=options.per_process,
        reassign=reassigner_of(scenario, plan),
    )


async def _unless_lost(swarm: Swarm, *work: Coroutine[Any, Any, Result]) -> list[Result]:
    """Do it all at once; raises InputError when a vehicle is lost meanwhile."""
    together = asyncio.gather(*work)
    while True:
        done, _ = await asyncio.wait({together}, timeout=LOSS_PERIOD_S)
        if done:
            return together.result()
        for sysid, endpoint in swarm.endpoints.items():
            if reason := endpoint.obituary():
                together.cancel()
                raise InputError(f"vehicle {sysid} lost before the flight: {reason}")


async def _arm_in_auto(vehicle: VehicleLink) -> None:
    await arm(vehicle)
    await set_mode(vehicle, Mode.AUTO)


async def _fly_held(
    scenario: Scenario,
    plan: FormationPlan,
    swarm: Swarm,
    fleet: Fleet,
    display: Display,
    announce: Announce,
    real_time: bool,
    steer: Steer | None,
) -> tuple[list[Event], dict[int, float]]:
    """Release the clocks, watch, and stop them; returns the events and when each lost vehicle was lost."""
    references = plan.references(scenario)
    planned_s = {sysid: reference.duration_s for sysid, reference in references.items()}
    latest_s = {i: longest_s(one_s) if scenario.formation.swarm_clock else one_s for i, one_s in planned_s.items()}
    statuses = [
        VehicleStatus(uav.sysid, uav.name, planned_s[uav.sysid], latest_s[uav.sysid], len(uav.mission))
        for uav in plan.uavs
    ]
    with open_session(swarm.station_peer) as session:
        clock = SwarmClock(session, swarm.name, swarm.endpoints)
        await asyncio.to_thread(clock.start if real_time else clock.release, swarm.endpoints)
        watch = partial(watch_flight, statuses, fleet.vehicles, swarm.endpoints, display, fleet.check, announce)
        if steer is None:
            events = await watch()
        else:
            cockpit = Cockpit(swarm, fleet, clock, session, statuses)
            events = await _steered(steer(cockpit), watch)
            events = sorted(events + cockpit.interventions, key=lambda event: event.t_s)
        lost = {status.sysid: status.time_s for status in statuses if status.lost is not None}
        with contextlib.suppress(InputError):  # who does not answer is ended with the swarm
            await asyncio.to_thread(clock.stop, swarm.endpoints.keys() - lost.keys())
    return events, lost


async def _steered(steering: Awaitable[None], watch: Callable[[asyncio.Event], Awaitable[list[Event]]]) -> list[Event]:
    """Watch while somebody steers, until that ends, in whatever way."""
    ended = asyncio.Event()
    steerer = asyncio.ensure_future(steering)
    steerer.add_done_callback(lambda _: ended.set())
    try:
        events = await watch(ended)
    finally:
        steerer.cancel()
    await steerer
    return events


def _addresses(swarm: Swarm, port: int) -> dict[str, object]:
    """What endpoints.json says: where the station and each vehicle can be reached while they fly."""
    vehicles = [
        {
            "sysid": sysid,
            "pid": endpoint.process.pid,
            "tcp_port": endpoint.ready.tcp_port,
            "udp_port": endpoint.ready.udp_port,
        }
        for sysid, endpoint in swarm.endpoints.items()
        if endpoint.ready is not None
    ]
    return {"station_udp_port": port, "vehicles": vehicles}
