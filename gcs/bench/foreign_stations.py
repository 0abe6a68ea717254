"""The same work on the same endpoints by three stations: a plan for every vehicle, uploaded, read back and compared.

Each station gets the endpoints for itself: they report to one UDP port, which one station after the other opens. A time
starts when all vehicles have been heard, and ends when all plans have been read back.
"""

import asyncio
import tempfile
import time
from collections.abc import Mapping
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from gcs.bench.mavproxy_station import MavProxy
from gcs.bench.mavsdk_station import MavsdkStation, from_raw_items, plugin, to_raw_items
from gcs.bench.peers import LOOPBACK, PATIENCE_S, free_udp_port
from gcs.fleet import Fleet
from gcs.links.udp import UdpLink
from gcs.transfers.errors import TransferError
from gcs.transfers.plans import upload_and_verify
from missions.commands import Command, Frame
from missions.formats.waypoints import write_waypoints
from missions.formats.waypoints_reader import read_waypoints
from missions.mission import Mission, MissionItem
from missions.plan_type import PlanType
from missions.scenario import Scenario, VehicleModel
from sitl.swarm import Swarm, SwarmOptions

Missions = Mapping[int, Mission]
"""By system id."""

_SPACING_E7 = 20_000
_MAVPROXY_STEP_E7 = 10
"""MAVProxy writes six decimals of a degree, truncates once on its way, and one float32 is between."""


@dataclass(frozen=True)
class StationTimes:
    """Seconds from "all heard" to "all read back and as sent", of each station, for the same missions."""

    n_vehicles: int
    n_items: int
    skein_s: float
    mavsdk_s: float
    mavproxy_s: float


def compare_stations(scenario: Scenario, n_items: int = 20) -> StationTimes:
    """Let Skein, MAVSDK and MAVProxy upload and read back a mission of `n_items` on every vehicle of a scenario.

    Raises:
        InputError: a foreign station is not installed.
        TransferError: a vehicle holds something else than was sent.
        TimeoutError: a foreign station came to no end.
    """
    port = free_udp_port()
    options = SwarmOptions(seed=1, delay_s=0.0, stations=((LOOPBACK, port),))
    with Swarm(scenario, options):
        missions = {vehicle.sysid: practice_mission(scenario, vehicle, n_items) for vehicle in scenario.vehicles}
        times_s = [time_station(port, missions) for time_station in (time_mavproxy, time_mavsdk, time_skein)]
    mavproxy_s, mavsdk_s, skein_s = times_s
    return StationTimes(len(missions), n_items, skein_s, mavsdk_s, mavproxy_s)


def practice_mission(scenario: Scenario, vehicle: VehicleModel, n_items: int) -> Mission:
    """A mission of `n_items`, home included: straight north from where the vehicle is."""
    x_m, y_m, z_m = scenario.origin_m(vehicle)
    lat_e7, lon_e7 = scenario.frame.to_e7(x_m, y_m)
    alt_m = scenario.origin.alt_m + z_m
    return Mission(
        tuple(
            MissionItem(
                Command.NAV_WAYPOINT, Frame.GLOBAL, lat_e7=lat_e7 + _SPACING_E7 * seq, lon_e7=lon_e7, alt_m=alt_m + seq
            )
            for seq in range(n_items)
        )
    )


def time_skein(port: int, missions: Missions) -> float:
    """Skein's station, all vehicles at once."""

    async def work() -> float:
        async with Fleet() as fleet:
            fleet.attach(await UdpLink.open(port))
            vehicles = await fleet.wait_for(sorted(missions), PATIENCE_S)
            start_s = time.perf_counter()
            await asyncio.gather(
                *(upload_and_verify(vehicle, PlanType.MISSION, missions[vehicle.sysid]) for vehicle in vehicles)
            )
            return time.perf_counter() - start_s

    return asyncio.run(work())


def time_mavsdk(port: int, missions: Missions) -> float:
    """One MAVSDK, all vehicles at once, a thread each."""

    def transfer(sysid: int, raw: Any) -> None:
        raw.upload_mission(to_raw_items(missions[sysid].items))
        _check("MAVSDK", sysid, missions[sysid], Mission(from_raw_items(raw.download_mission())), step_e7=0)

    with MavsdkStation(f"udpin://{LOOPBACK}:{port}") as station, ThreadPoolExecutor(len(missions)) as threads:
        sysids = sorted(missions)
        systems = [plugin("mission_raw", system) for system in station.wait_for(sysids)]
        start_s = time.perf_counter()
        list(threads.map(transfer, sysids, systems))
        return time.perf_counter() - start_s


def time_mavproxy(port: int, missions: Missions) -> float:
    """One MAVProxy, one vehicle after the other, as it knows no other way."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for sysid, mission in missions.items():
            write_waypoints(mission, folder / f"{sysid}.waypoints")
        with MavProxy(f"udpin:{LOOPBACK}:{port}", folder) as proxy:
            for sysid in missions:
                proxy.wait_for(f"Detected vehicle {sysid}:1 ")
            start_s = time.perf_counter()
            for sysid in missions:
                proxy.ask(f"vehicle {sysid}", f"Set vehicle {sysid} ")
                proxy.ask(f"wp load {sysid}.waypoints", "Got MISSION_ACK: TYPE_MISSION: ACCEPTED")
                proxy.ask(f"wp save {sysid}.held", r"Saved \d+ waypoints")
            duration_s = time.perf_counter() - start_s
        for sysid, mission in missions.items():
            held = read_waypoints(folder / f"{sysid}.held")
            _check("MAVProxy", sysid, mission, held, step_e7=_MAVPROXY_STEP_E7)
    return duration_s


def _check(station: str, sysid: int, sent: Mission, held: Mission, step_e7: int) -> None:
    """Raise TransferError unless the plans agree; home is the vehicle's own."""
    same = len(sent) == len(held) and all(
        (wanted.command, wanted.alt_m) == (found.command, found.alt_m)
        and abs(wanted.lat_e7 - found.lat_e7) <= step_e7
        and abs(wanted.lon_e7 - found.lon_e7) <= step_e7
        for wanted, found in zip(sent.items[1:], held.items[1:], strict=True)
    )
    if not same:
        raise TransferError(f"vehicle {sysid} holds another mission than {station} sent")
