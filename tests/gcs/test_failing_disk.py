"""A plan that a vehicle cannot keep is refused, and the station is told why: never ACCEPTED and lost."""

import asyncio
import os
import sys
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager
from pathlib import Path

import pytest

from gcs.bench.killed_transfers import two_plans
from gcs.fleet import Fleet
from gcs.links.open_link import open_link
from gcs.transfers.compare import differences
from gcs.transfers.errors import TransferError
from gcs.transfers.plans import download, upload_and_verify
from gcs.vehicle_link import VehicleLink
from missions.plan_type import HELD
from missions.scenario import Scenario, load_scenario
from sitl.child import Endpoint
from sitl.swarm import Swarm, SwarmOptions

if sys.platform != "linux":
    pytest.skip("the files of another process cannot be limited there", allow_module_level=True)

import resource

ITEMS = 4
PATIENCE_S = 20.0
Broken = Callable[[Endpoint, Path], AbstractContextManager[None]]


@pytest.fixture(scope="module")
def vee() -> Scenario:
    return load_scenario("vee")


@contextmanager
def full_disk(endpoint: Endpoint, folder: Path) -> Iterator[None]:
    assert endpoint.process.pid is not None
    limits = resource.prlimit(endpoint.process.pid, resource.RLIMIT_FSIZE)
    resource.prlimit(endpoint.process.pid, resource.RLIMIT_FSIZE, (10, limits[1]))
    yield
    resource.prlimit(endpoint.process.pid, resource.RLIMIT_FSIZE, limits)


@contextmanager
def read_only_folder(endpoint: Endpoint, folder: Path) -> Iterator[None]:
    folder.chmod(0o555)
    yield
    folder.chmod(0o755)


@contextmanager
def file_in_its_place(endpoint: Endpoint, folder: Path) -> Iterator[None]:
    aside = folder.rename(folder.with_name("aside"))
    folder.write_text("")
    yield
    folder.unlink()
    aside.rename(folder)


@pytest.mark.parametrize(
    ("broken", "reason"),
    [
        (full_disk, "File too large"),
        pytest.param(
            read_only_folder,
            "Permission denied",
            marks=pytest.mark.skipif(os.geteuid() == 0, reason="root may write anywhere"),
        ),
        (file_in_its_place, "File exists"),
    ],
)
def test_a_real_endpoint_refuses_the_plan_with_the_reason_and_has_the_old_one_after_a_restart_too(
    vee: Scenario, tmp_path: Path, broken: Broken, reason: str
) -> None:
    plans = {plan: two_plans(plan, ITEMS) for plan in HELD}

    async def refuse(port: int, failing: AbstractContextManager[None]) -> None:
        async with Fleet() as fleet:
            vehicle = await find(fleet, port)
            for plan, (old, _) in plans.items():
                await upload_and_verify(vehicle, plan, old)
            with failing:
                for plan, (_, new) in plans.items():
                    with pytest.raises(TransferError, match=f"MAV_MISSION_ERROR.*{reason}; old one kept"):
                        await upload_and_verify(vehicle, plan, new)
            await hold_the_old(vehicle)

    async def hold_the_old(vehicle: VehicleLink) -> None:
        for plan, (old, _) in plans.items():
            assert differences(plan, old, await download(vehicle, plan)) == []

    async def take(port: int) -> None:
        async with Fleet() as fleet:
            vehicle = await find(fleet, port)
            await hold_the_old(vehicle)
            for plan, (_, new) in plans.items():
                await upload_and_verify(vehicle, plan, new)

    async def find(fleet: Fleet, port: int) -> VehicleLink:
        fleet.attach(await open_link(f"udpout://127.0.0.1:{port}"))
        return (await fleet.wait_for([sysid], PATIENCE_S))[0]

    with Swarm(vee, SwarmOptions(seed=1, delay_s=0.2, memory=tmp_path, count=1)) as swarm:
        (sysid,) = swarm.endpoints
        asyncio.run(refuse(udp_port(swarm), broken(swarm.endpoints[sysid], tmp_path / str(sysid))))
        swarm.restart(sysid)
        asyncio.run(take(udp_port(swarm)))


def udp_port(swarm: Swarm) -> int:
    (endpoint,) = swarm.endpoints.values()
    assert endpoint.ready is not None
    return endpoint.ready.udp_port
