"""The three things that a console shows: a recorded flight, a flight that it steers, and vehicles that are there."""

import asyncio
import contextlib
from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np
import viser
from pymavlink.dialects.v20 import ardupilotmega as mavlink

from gcs.console.fleet_pilots import FleetPilots
from gcs.console.helm import Helm
from gcs.console.live import Live
from gcs.console.logged_modes import read_modes
from gcs.console.page import FEW, Page
from gcs.console.place import Place, place_of, unknown_place
from gcs.console.present import present
from gcs.console.recording import Recording
from gcs.console.swarm_helm import SwarmHelm
from gcs.fleet import Fleet
from gcs.flight import Cockpit, Steer
from gcs.report_page.flown_run import FlownRun
from gcs.transfers.errors import TransferError
from gcs.transfers.message_interval import set_message_interval
from gcs.vehicle_link import VehicleLink
from gcs.watch import VehicleStatus
from missions.errors import InputError
from missions.frame import LocalFrame
from missions.scenario import Scenario
from planner.formation_plan import FormationPlan
from sitl.formation.graph import edges

STREAMED = (
    mavlink.MAVLINK_MSG_ID_ATTITUDE,
    mavlink.MAVLINK_MSG_ID_GLOBAL_POSITION_INT,
    mavlink.MAVLINK_MSG_ID_VFR_HUD,
)
"""ATTITUDE first: a position is shown with the attitude that was heard last."""
STREAM_S = 0.25
"""Between two of them, wall time."""
USUAL_STREAM_S = 1.0
"""What vehicles do unless asked, their time."""
FAREWELL_S = 0.2
"""For the last word to reach the browsers."""
POLL_S = 0.25
"""How often a swarm is asked for its links."""


async def show_recording(
    server: viser.ViserServer, run: FlownRun, logs: Path, until: asyncio.Event, at_s: float | None = None
) -> None:
    """Show a flight that is over until the event is set; from its beginning, or as it was at some time.

    Args:
        server: of the page.
        run: that was flown.
        logs: the folder of its telemetry logs, where there are any.
        until: the end.
        at_s: where the recording stands still; None to play it.
    """
    source = Recording(run, {sysid: read_modes(logs / f"{sysid}.tlog", sysid) for sysid in run.truths})
    if at_s is not None:
        source.t_s, source.playing = at_s, False
    page = Page(server, place_of(run.scenario, run.plan), source, Helm())
    await present(page, source, until)


def steering(
    server: viser.ViserServer,
    scenario: Scenario,
    plan: FormationPlan,
    speed: float,
    until: asyncio.Event,
    farewell: str = "The flight has ended",
) -> Steer:
    """Who shows a flight of a plan, and lets users steer it, until the event is set.

    Args:
        server: of the page.
        scenario, plan: that are flown.
        speed: that the flight begins with; 0 for as fast as it goes.
        until: the end.
        farewell: what the page says then.
    """

    async def steer(cockpit: Cockpit) -> None:
        helm = SwarmHelm(cockpit, speed)
        sysids = [uav.sysid for uav in plan.uavs]
        with contextlib.ExitStack() as stack:
            source = Live(
                cockpit.fleet,
                scenario.frame,
                {uav.sysid: uav.name for uav in plan.uavs},
                plan.references(scenario),
                edges(scenario.formation.graph, sysids),
                simulated=True,
                stack=stack,
            )
            page = Page(
                server,
                place_of(scenario, plan),
                source,
                Helm(FleetPilots(cockpit.fleet, helm.note, lambda: source.lost), helm, helm),
                end=until.set,
            )

            def also() -> None:
                lost = {status.sysid: status.lost for status in cockpit.statuses if status.lost is not None}
                for sysid in lost.keys() - source.lost.keys():
                    page.tell(f"vehicle {sysid} lost: {lost[sysid].removeprefix(f'vehicle {sysid}: ')}")
                source.lost = lost
                source.doing = _doing(cockpit.statuses)

            background = [
                asyncio.create_task(_poll_links(source, helm)),
                asyncio.create_task(_stream(list(cockpit.fleet.vehicles.values()), lambda: helm.speed)),
            ]
            try:
                await present(page, source, until, also)
            finally:
                for task in background:
                    task.cancel()
                page.bid_farewell(farewell)
                await asyncio.sleep(FAREWELL_S)

    return steer


def _doing(statuses: Sequence[VehicleStatus]) -> str:
    """How far a flight is; it lasts until somebody ends it."""
    arrived = sum(status.arrived for status in statuses)
    lost = sum(status.lost is not None for status in statuses)
    if arrived and arrived + lost >= len(statuses):
        return f"{arrived} of {len(statuses)} arrived: end the flight"
    return f"{arrived} of {len(statuses)} arrived" if arrived else "flying"


async def watch_fleet(
    server: viser.ViserServer,
    fleet: Fleet,
    scenario: Scenario | None,
    plan: FormationPlan | None,
    until: asyncio.Event,
) -> None:
    """Show vehicles that are there, and let users give them orders, until the event is set.

    Args:
        server: of the page.
        fleet: that hears them.
        scenario, plan: where they are and what they are to fly, as far as that is known.
        until: the end.

    Raises:
        InputError: without a scenario, no vehicle tells where it is.
    """
    sysids = [] if plan is None else [uav.sysid for uav in plan.uavs]
    place = await _place_of_fleet(fleet) if scenario is None else place_of(scenario, plan)
    names = {} if scenario is None else {vehicle.sysid: vehicle.name for vehicle in scenario.vehicles}
    with contextlib.ExitStack() as stack:
        source = Live(
            fleet,
            place.frame,
            names,
            {} if scenario is None or plan is None else plan.references(scenario),
            edges(scenario.formation.graph, sysids) if scenario is not None and sysids else (),
            simulated=False,
            stack=stack,
        )
        page = Page(server, place, source, Helm(FleetPilots(fleet)))
        asked: set[int] = set()
        tasks: list[asyncio.Task[None]] = []

        def also() -> None:
            new = [vehicle for sysid, vehicle in fleet.vehicles.items() if sysid not in asked]
            asked.update(vehicle.sysid for vehicle in new)
            if new and len(asked) <= FEW:  # of many, the usual rate will do
                tasks.append(asyncio.create_task(_ask_for_streams(new, STREAM_S)))

        try:
            await present(page, source, until, also)
        finally:
            for task in tasks:
                task.cancel()


async def _place_of_fleet(fleet: Fleet) -> Place:
    """Around where vehicles are that have been heard. Raises InputError when none tells where it is."""
    for _ in range(50):
        positions = [
            message
            for vehicle in fleet.vehicles.values()
            if (message := vehicle.latest.get("GLOBAL_POSITION_INT")) is not None and (message.lat or message.lon)
        ]
        if positions and len(positions) == len(fleet.vehicles):
            break
        await asyncio.sleep(0.1)
    if not positions:
        raise InputError("no vehicle tells where it is (GLOBAL_POSITION_INT); wait until one has a position")
    first = positions[0]
    frame = LocalFrame(first.lat / 1e7, first.lon / 1e7, 0.0)
    return unknown_place(frame, np.array([(*frame.from_e7(one.lat, one.lon), one.alt / 1000.0) for one in positions]))


async def _poll_links(source: Live, helm: SwarmHelm) -> None:
    while True:
        with contextlib.suppress(InputError):  # who was just lost does not answer
            source.ages_s = await helm.ages_s()
        await asyncio.sleep(POLL_S)


async def _stream(vehicles: Sequence[VehicleLink], speed: Callable[[], float]) -> None:
    """Ask vehicles for as many positions a second as the eye needs, whenever the speed of their clock has changed."""
    asked_s = USUAL_STREAM_S
    while True:
        wanted_s = min(USUAL_STREAM_S, STREAM_S * speed()) if speed() else USUAL_STREAM_S
        if wanted_s != asked_s:
            asked_s = wanted_s
            await _ask_for_streams(vehicles, wanted_s)
        await asyncio.sleep(POLL_S)


async def _ask_for_streams(vehicles: Sequence[VehicleLink], interval_s: float) -> None:
    async def ask(vehicle: VehicleLink) -> None:
        for message_id in STREAMED:
            with contextlib.suppress(TransferError):  # it is shown as often as it tells
                await set_message_interval(vehicle, message_id, interval_s)

    await asyncio.gather(*map(ask, vehicles))
