"""What a console costs: processor time of its process while a page shows a swarm that flies, counted at the WebSocket.

It counts all that the process does: telemetry, the moment that is shown, table and plots, and what the server sends.
The vehicles, and who looks at the page, are processes of their own.
"""

import asyncio
import contextlib
import multiprocessing
import resource
import tempfile
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import viser

from gcs.bench.page_viewer import view
from gcs.console.console import steering, watch_fleet
from gcs.console.server import close_server, open_server
from gcs.fleet import Fleet
from gcs.flight import FlightOptions, fly
from gcs.links.udp import UdpLink
from gcs.run_folder import make_run_folder
from gcs.transfers.command import arm, set_mode
from gcs.transfers.for_all import for_all
from gcs.vehicle_link import VehicleLink
from missions.scenario import load_scenario, read_scenario_text
from planner.plan import plan
from sitl.modes import Mode
from sitl.services.links import LOOPBACK
from sitl.swarm import Swarm, SwarmOptions

SCENARIO = "vee"
SETTLED_S = 3.0
"""Until the page has what it is given once, and telemetry comes as often as it was asked for."""


@dataclass(frozen=True)
class ConsoleLoad:
    """What came of it.

    Attributes:
        vehicles: that flew.
        frames_hz: how often the aircraft were placed anew, a second.
        poses_hz: of all of them, a second.
        bytes_s: that came over the WebSocket, a second.
        core: processor time of the console's process, as a fraction of one core.
    """

    vehicles: int
    frames_hz: float
    poses_hz: float
    bytes_s: float
    core: float


async def nine_flying(seconds: float) -> ConsoleLoad:
    """The nine of a scenario in flight, at real time."""
    text, _ = read_scenario_text(SCENARIO)
    scenario = load_scenario(SCENARIO)
    formation = plan(scenario)
    until = asyncio.Event()
    found: list[ConsoleLoad] = []
    with tempfile.TemporaryDirectory() as folder, _page() as server:
        run = make_run_folder(Path(folder) / "run", scenario.name)
        run.write_plan(text, scenario, formation)
        options = FlightOptions(delay_s=scenario.formation.delay_s, speed=1.0)
        steer = steering(server, scenario, formation, 1.0, until)
        measuring = asyncio.create_task(_measure(server, len(formation.uavs), seconds, found, until))
        await fly(scenario, formation, run, options, lambda _: None, lambda _: None, steer)
        await measuring
    return found[0]


async def many_connected(count: int, seconds: float) -> ConsoleLoad:
    """So many vehicles of a simulation, flying at real time, as a console hears them over MAVLink."""
    scenario = load_scenario(SCENARIO)
    until = asyncio.Event()
    found: list[ConsoleLoad] = []
    async with Fleet() as fleet:
        link = await UdpLink.open()
        fleet.attach(link)
        options = SwarmOptions(
            seed=1, delay_s=0.2, arm="plain", held=False, speed=1.0, stations=((LOOPBACK, link.port),), count=count
        )
        with Swarm(scenario, options) as swarm, _page() as server:
            vehicles = await fleet.wait_for(swarm.sysids, timeout_s=60.0)
            await for_all(vehicles, _take_off)
            measuring = asyncio.create_task(_measure(server, count, seconds, found, until))
            await watch_fleet(server, fleet, scenario, None, until)
            await measuring
    return found[0]


async def _take_off(vehicle: VehicleLink) -> None:
    await arm(vehicle)
    await set_mode(vehicle, Mode.TAKEOFF)


@contextlib.contextmanager
def _page() -> Iterator[viser.ViserServer]:
    server = open_server(LOOPBACK, 0, None)
    try:
        yield server
    finally:
        close_server(server)


async def _measure(
    server: viser.ViserServer, vehicles: int, seconds: float, found: list[ConsoleLoad], until: asyncio.Event
) -> None:
    """Look at the page from another process for so long, then end."""
    context = multiprocessing.get_context("spawn")
    ours, theirs = context.Pipe()
    viewer = context.Process(target=view, args=(server.get_port(), theirs), daemon=True)
    viewer.start()
    theirs.close()
    try:
        await asyncio.to_thread(ours.recv)
        await asyncio.sleep(SETTLED_S)
        before_s = _processor_s()
        ours.send(None)
        await asyncio.sleep(seconds)
        core_s = _processor_s() - before_s
        ours.send(None)
        frames, poses, size, passed_s = await asyncio.to_thread(ours.recv)
        found.append(ConsoleLoad(vehicles, frames / passed_s, poses / passed_s, size / passed_s, core_s / passed_s))
    finally:
        until.set()
        viewer.terminate()
        await asyncio.to_thread(viewer.join)


def _processor_s() -> float:
    usage = resource.getrusage(resource.RUSAGE_SELF)
    return usage.ru_utime + usage.ru_stime
