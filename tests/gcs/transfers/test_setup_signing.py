"""Keys on their way to a vehicle, and what the station hears of whom with them: over real sockets on loopback."""

import asyncio
from collections.abc import Coroutine
from pathlib import Path
from typing import Any

import pytest

import gcs.transfers.setup_signing as module
from gcs.fleet import Fleet
from gcs.links.tcp import TcpLink
from gcs.tlog import TelemetryLog
from gcs.transfers.errors import TransferError
from gcs.transfers.plans import upload_and_verify
from gcs.transfers.setup_signing import setup_signing
from missions.errors import InputError
from missions.plan_type import PlanType
from sitl.services.signing import Signing
from sitl.store import Store

LOOPBACK = "127.0.0.1"
PATIENCE_S = 10.0
KEY, OTHER_KEY = bytes(range(32)), bytes(range(1, 33))


def run(main: Coroutine[Any, Any, None]) -> None:
    asyncio.run(asyncio.wait_for(main, 60.0))


def test_a_key_is_given_changed_and_taken_away(
    make_vehicle: Any, make_mission: Any, serve: Any, tmp_path: Path
) -> None:
    vehicle, store = make_vehicle(4), Store()
    links = serve(vehicle, signing=Signing(store))

    async def main() -> None:
        async with Fleet(lambda sysid: TelemetryLog(tmp_path / "4.tlog", 1e9)) as fleet:
            fleet.attach(await TcpLink.connect(LOOPBACK, links.tcp_port))
            (found,) = await fleet.wait_for([4], PATIENCE_S)
            for key in (KEY, OTHER_KEY, None):
                await setup_signing(found, Signing(key=key))
                with vehicle.lock:
                    assert Signing(store).key == key
                assert await upload_and_verify(found, PlanType.MISSION, make_mission(9)) == 9

    run(main())
    recorded = (tmp_path / "4.tlog").read_bytes()
    assert recorded
    assert KEY not in recorded
    assert OTHER_KEY not in recorded


def test_a_vehicle_that_takes_no_key_is_told_in_its_own_words(
    make_vehicle: Any, make_mission: Any, serve: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(module, "PATIENCE_S", 0.1)
    vehicle = make_vehicle(4)
    vehicle.change(armed=True)
    links = serve(vehicle)

    async def main() -> None:
        async with Fleet() as fleet:
            fleet.attach(await TcpLink.connect(LOOPBACK, links.tcp_port))
            (found,) = await fleet.wait_for([4], PATIENCE_S)
            with pytest.raises(TransferError, match=r"^vehicle 4: does not sign with the new key; it says: .*: armed"):
                await setup_signing(found, Signing(key=KEY))
            assert await upload_and_verify(found, PlanType.MISSION, make_mission(9)) == 9

    run(main())


def test_with_a_key_a_station_talks_to_whoever_has_it(make_vehicle: Any, make_mission: Any, serve: Any) -> None:
    links = serve(make_vehicle(4), signing=Signing(key=KEY))

    async def main() -> None:
        async with Fleet(signing=Signing(key=KEY)) as fleet:
            fleet.attach(await TcpLink.connect(LOOPBACK, links.tcp_port))
            (found,) = await fleet.wait_for([4], PATIENCE_S)
            assert await upload_and_verify(found, PlanType.MISSION, make_mission(9)) == 9
            assert fleet.complaints() == []

    run(main())


@pytest.mark.parametrize(("key", "said"), [(None, "unsigned: give it the key"), (OTHER_KEY, "wrongly signed: check")])
def test_who_has_not_the_key_is_not_heard_and_named(make_vehicle: Any, serve: Any, key: bytes, said: str) -> None:
    links = serve(make_vehicle(4), signing=Signing(key=key))

    async def main() -> None:
        async with Fleet(signing=Signing(key=KEY)) as fleet:
            fleet.attach(await TcpLink.connect(LOOPBACK, links.tcp_port))
            with pytest.raises(InputError, match=rf"^vehicle 4: no heartbeat .*; vehicle 4: \d+ frames? {said}"):
                await fleet.wait_for([4], 0.3)
            with pytest.raises(InputError, match=rf"^no vehicle heard within 0 s; vehicle 4: \d+ frames? {said}"):
                await fleet.discover(0.0)

    run(main())
