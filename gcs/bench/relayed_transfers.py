"""How uploads fare between the station and endpoints in processes of their own, over relays that lose and delay."""

import asyncio
import contextlib
import math
import statistics
import time
from dataclasses import dataclass, replace

from gcs.bench.foreign_stations import practice_mission
from gcs.bench.lossy_relay import LossyRelay
from gcs.bench.peers import LOOPBACK, PATIENCE_S
from gcs.fleet import Fleet
from gcs.links.udp import UdpLink
from gcs.transfers.errors import TransferError
from gcs.transfers.plans import upload_and_verify
from missions.mission import Mission
from missions.plan_type import PlanType
from missions.scenario import load_scenario
from sitl.swarm import Swarm, SwarmOptions


@dataclass(frozen=True)
class RelayedTransfers:
    """Uploads of one mission over real sockets.

    Attributes:
        loss: part of the messages that is lost, each way.
        delay_s: what each message takes.
        uploads: how many.
        failed: how many ended with an error.
        median_s, slowest_s: wall time until the vehicle has the mission and it has been read back and compared;
            infinite when most failed, or any.
        kinds_lost: the MISSION_* messages that were lost.
    """

    loss: float
    delay_s: float
    uploads: int
    failed: int
    median_s: float
    slowest_s: float
    kinds_lost: tuple[str, ...]


def measure_relayed(
    loss: float, uploads: int, n_items: int = 100, delay_s: float = 0.05, n_vehicles: int = 9
) -> RelayedTransfers:
    """Upload missions of `n_items` and read them back, `uploads` times, to as many vehicles at once."""
    scenario = load_scenario("vee")
    vehicles = scenario.vehicles[:n_vehicles]
    kinds_lost: set[str] = set()

    async def upload(sysid: int, udp_port: int, mission: Mission, seed: int) -> float:
        """As a station that has never heard of the vehicle; seconds, or infinity for none."""
        with contextlib.closing(LossyRelay(udp_port, loss, seed, delay_s)) as relay:
            async with Fleet() as fleet:
                fleet.attach(await UdpLink.connect(LOOPBACK, relay.port))
                (vehicle,) = await fleet.wait_for([sysid], PATIENCE_S)
                start_s = time.perf_counter()
                try:
                    await upload_and_verify(vehicle, PlanType.MISSION, mission)
                except TransferError:
                    return math.inf
                took_s = time.perf_counter() - start_s
        kinds_lost.update(kind for kind in relay.kinds_lost if kind.startswith("MISSION_"))
        return took_s

    async def upload_some(swarm: Swarm, first: int) -> list[float]:
        """Every `n_vehicles`-th of the uploads, one after the other, each of another mission."""
        ready = swarm.endpoints[vehicles[first].sysid].ready
        assert ready is not None
        items = practice_mission(scenario, vehicles[first], n_items).items
        took_s = []
        for seed in range(first, uploads, n_vehicles):
            mission = Mission(tuple(replace(item, alt_m=item.alt_m + seed) for item in items))
            took_s.append(await upload(vehicles[first].sysid, ready.udp_port, mission, seed))
        return took_s

    async def upload_all(swarm: Swarm) -> list[float]:
        chains = await asyncio.gather(*(upload_some(swarm, first) for first in range(len(vehicles))))
        return [took_s for chain in chains for took_s in chain]

    with Swarm(scenario.model_copy(update={"vehicles": vehicles}), SwarmOptions(seed=1, delay_s=0.0)) as swarm:
        took_s = asyncio.run(upload_all(swarm))
    failed = sum(map(math.isinf, took_s))
    median_s, slowest_s = statistics.median(took_s), max(took_s)
    return RelayedTransfers(loss, delay_s, uploads, failed, median_s, slowest_s, tuple(sorted(kinds_lost)))
