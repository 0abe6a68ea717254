"""What a swarm of endpoints costs: seconds until it is ready, memory, and how fast all its parameters are fetched."""

import asyncio
import time
from dataclasses import dataclass
from pathlib import Path

from gcs.bench.peers import PATIENCE_S, free_udp_port
from gcs.fleet import Fleet
from gcs.links.udp import UdpLink
from gcs.transfers.parameters import fetch_parameters
from missions.scenario import Scenario
from sitl.services.links import LOOPBACK
from sitl.swarm import Swarm, SwarmOptions

_KIB_PER_MIB = 1024


@dataclass(frozen=True)
class Footprint:
    """Of one swarm, a process each.

    Attributes:
        vehicles: how many.
        ready_s: from the command to start them until all answer.
        pss_mib: proportional set size of all their processes and the one that they are forked from; None where the
            system does not tell.
        parameters: fetched of all vehicles together.
        parameters_s: for that, all vehicles at once.
    """

    vehicles: int
    ready_s: float
    pss_mib: float | None
    parameters: int
    parameters_s: float


def measure_footprint(scenario: Scenario) -> Footprint:
    """Start the vehicles of a scenario, weigh them, and fetch their parameters."""
    port = free_udp_port()
    start_s = time.perf_counter()
    with Swarm(scenario, SwarmOptions(seed=1, delay_s=0.2, stations=((LOOPBACK, port),))) as swarm:
        ready_s = time.perf_counter() - start_s
        sysids = sorted(swarm.endpoints)
        parameters, parameters_s = asyncio.run(_fetch(port, sysids))
        pids = {endpoint.process.pid for endpoint in swarm.endpoints.values()}
        return Footprint(len(sysids), ready_s, _pss_mib(pids - {None}), parameters, parameters_s)


async def _fetch(port: int, sysids: list[int]) -> tuple[int, float]:
    async with Fleet() as fleet:
        fleet.attach(await UdpLink.open(port))
        vehicles = await fleet.wait_for(sysids, PATIENCE_S)
        start_s = time.perf_counter()
        fetched = await asyncio.gather(*(fetch_parameters(vehicle) for vehicle in vehicles))
        return sum(map(len, fetched)), time.perf_counter() - start_s


def _pss_mib(pids: set[int | None]) -> float | None:
    """Of these processes and the nest that they are forked from."""
    try:
        parents = {int(Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[1]) for pid in pids}
        return sum(_pss_kib(pid) for pid in pids | parents) / _KIB_PER_MIB
    except OSError:
        return None


def _pss_kib(pid: int | None) -> int:
    for line in Path(f"/proc/{pid}/smaps_rollup").read_text().splitlines():
        if line.startswith("Pss:"):
            return int(line.split()[1])
    return 0
