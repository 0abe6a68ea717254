"""The station against endpoints' faces over real sockets on loopback."""

import asyncio
from collections import Counter
from collections.abc import Coroutine
from pathlib import Path
from typing import Any

import pytest
from pymavlink import mavutil

from gcs.fleet import Fleet
from gcs.links.tcp import TcpLink
from gcs.links.udp import UdpLink
from gcs.tlog import TelemetryLog
from gcs.transfers.command import arm, command, disarm, set_mode
from gcs.transfers.errors import TransferError
from gcs.transfers.plans import download, upload_and_verify
from missions.errors import InputError
from missions.plan_type import PlanType
from sitl.modes import Mode

LOOPBACK = "127.0.0.1"
PATIENCE_S = 10.0


def run(main: Coroutine[Any, Any, None]) -> None:
    """Run a test's coroutine, not for ever."""
    asyncio.run(asyncio.wait_for(main, 60.0))


def test_nine_vehicles_get_their_own_missions_at_once(
    make_vehicle: Any, make_mission: Any, serve: Any, tmp_path: Path
) -> None:
    vehicles = [make_vehicle(sysid) for sysid in range(1, 10)]
    missions = [make_mission(20 + sysid) for sysid in range(1, 10)]

    async def main() -> None:
        link = await UdpLink.open()
        async with Fleet(lambda sysid: TelemetryLog(tmp_path / f"{sysid}.tlog", 1e9)) as fleet:
            fleet.attach(link)
            for vehicle in vehicles:
                serve(vehicle, (LOOPBACK, link.port))
            found = await fleet.wait_for(range(1, 10), PATIENCE_S)
            assert [vehicle.sysid for vehicle in found] == list(range(1, 10))
            pairs = zip(found, missions, strict=True)
            counts = await asyncio.gather(
                *(upload_and_verify(vehicle, PlanType.MISSION, mission) for vehicle, mission in pairs)
            )
            assert counts == [len(mission) for mission in missions]
            await asyncio.gather(*(arm(vehicle) for vehicle in found))
            await asyncio.gather(*(set_mode(vehicle, Mode.AUTO) for vehicle in found))
            assert [vehicle.lost_frames for vehicle in found] == [0] * 9

    run(main())
    assert [vehicle.mission for vehicle in vehicles] == missions
    assert all(vehicle.state.armed and vehicle.state.mode == Mode.AUTO for vehicle in vehicles)
    for sysid in range(1, 10):
        log = mavutil.mavlink_connection(str(tmp_path / f"{sysid}.tlog"))
        logged = Counter((message.get_type(), message.get_srcSystem()) for message in iter(log.recv_match, None))
        log.close()
        items = len(missions[sysid - 1])
        assert logged["MISSION_ITEM_INT", 255] == logged["MISSION_ITEM_INT", sysid] == items
        assert logged["COMMAND_LONG", 255] == logged["COMMAND_ACK", sysid] == 2


def test_one_vehicle_over_tcp(make_vehicle: Any, make_mission: Any, serve: Any) -> None:
    vehicle = make_vehicle(4)
    links = serve(vehicle)

    async def main() -> None:
        async with Fleet() as fleet:
            fleet.attach(await TcpLink.connect(LOOPBACK, links.tcp_port))
            (found,) = await fleet.wait_for([4], PATIENCE_S)
            assert await upload_and_verify(found, PlanType.MISSION, make_mission(100)) == 100
            assert await download(found, PlanType.MISSION) == make_mission(100).items
            assert await command(found, 31_000) == 3

    run(main())


def test_refusals_carry_the_vehicles_own_words(make_vehicle: Any, make_mission: Any, serve: Any) -> None:
    vehicle = make_vehicle(4)
    links = serve(vehicle)

    async def main() -> None:
        async with Fleet() as fleet:
            fleet.attach(await TcpLink.connect(LOOPBACK, links.tcp_port))
            (found,) = await fleet.wait_for([4], PATIENCE_S)
            with pytest.raises(TransferError, match="vehicle 4: arming refused with MAV_RESULT_FAILED: no mission"):
                await arm(found)
            vehicle.refusal = "mission: the third leg of it climbs at 14 degrees, of which the airframe has only 8"
            with pytest.raises(TransferError, match=f"MAV_MISSION_ERROR.*it says: {vehicle.refusal}$"):
                await upload_and_verify(found, PlanType.MISSION, make_mission(9))
            vehicle.change(airborne=True, mode=Mode.AUTO)
            with pytest.raises(TransferError, match=r"MAV_MISSION_DENIED.*switch to LOITER first"):
                await upload_and_verify(found, PlanType.MISSION, make_mission(9))
            with pytest.raises(TransferError, match="disarming refused"):
                await disarm(found)

    run(main())


def test_a_mission_held_otherwise_is_reported_by_item_and_field(
    make_vehicle: Any, make_mission: Any, serve: Any
) -> None:
    vehicle = make_vehicle(4)
    other = make_mission(12)
    vehicle.load = lambda plan, items: setattr(vehicle, "mission", other)
    links = serve(vehicle)

    async def main() -> None:
        async with Fleet() as fleet:
            fleet.attach(await TcpLink.connect(LOOPBACK, links.tcp_port))
            (found,) = await fleet.wait_for([4], PATIENCE_S)
            with pytest.raises(TransferError, match="vehicle 4: holds another mission than was sent: 12 items held, 9"):
                await upload_and_verify(found, PlanType.MISSION, make_mission(9))

    run(main())


def test_two_vehicles_with_one_system_id_are_told_with_both_addresses(make_vehicle: Any, serve: Any) -> None:
    async def main() -> None:
        link = await UdpLink.open()
        async with Fleet() as fleet:
            fleet.attach(link)
            ports = [serve(make_vehicle(5), (LOOPBACK, link.port)).udp_port for _ in range(2)]
            with pytest.raises(InputError, match=r"system id 5 is used by udp .* and udp .*") as error:
                await fleet.wait_for([5, 6], PATIENCE_S)
            assert all(str(port) in str(error.value) for port in ports)

    run(main())


def test_missing_vehicles_are_named(make_vehicle: Any, serve: Any) -> None:
    async def main() -> None:
        link = await UdpLink.open()
        async with Fleet() as fleet:
            fleet.attach(link)
            serve(make_vehicle(2), (LOOPBACK, link.port))
            await fleet.wait_for([2], PATIENCE_S)
            with pytest.raises(InputError, match=r"^vehicle 1, 3: no heartbeat within 0\.2 s"):
                await fleet.wait_for([1, 2, 3], 0.2)

    run(main())


def test_ports_that_cannot_be_had_are_named() -> None:
    async def main() -> None:
        link = await UdpLink.open()
        with pytest.raises(InputError, match=f"UDP port {link.port} on 127.0.0.1: .*choose another port"):
            await UdpLink.open(link.port)
        await link.close()
        with pytest.raises(InputError, match=r"tcp 127.0.0.1:1: .*check the address"):
            await TcpLink.connect(LOOPBACK, 1)

    run(main())


def test_a_vehicle_on_two_links_is_heard_once_and_kept_when_one_is_cut(
    make_vehicle: Any, make_mission: Any, serve: Any
) -> None:
    vehicle = make_vehicle(4)
    news: list[str] = []

    async def main() -> None:
        udp = await UdpLink.open()
        links = serve(vehicle, (LOOPBACK, udp.port))
        tcp = await TcpLink.connect(LOOPBACK, links.tcp_port)
        async with Fleet(announce=news.append) as fleet:
            fleet.attach(tcp)
            (found,) = await fleet.wait_for([4], PATIENCE_S)
            fleet.attach(udp)
            assert await upload_and_verify(found, PlanType.MISSION, make_mission(9)) == 9
            while not fleet._routes[4].standby:
                await asyncio.sleep(0.01)
            assert found.peer == tcp.peer
            await tcp.close()
            tcp.on_lost(tcp.peer)
            async with asyncio.timeout(PATIENCE_S):
                while found.peer == tcp.peer:
                    await asyncio.sleep(0.01)
            assert found.peer.port == links.udp_port
            assert await upload_and_verify(found, PlanType.MISSION, make_mission(12)) == 12
            assert fleet.complaints() == []

    run(main())
    assert news[0] == f"tcp {LOOPBACK}:{news[0].split(':')[1]}: connection lost"
    assert news[1].startswith("vehicle 4: now heard over udp")


def test_nothing_is_lost_when_a_connection_breaks_and_comes_back(make_vehicle: Any, serve: Any) -> None:
    links = serve(make_vehicle(4))
    news: list[str] = []

    async def main() -> None:
        link = await TcpLink.connect(LOOPBACK, links.tcp_port)
        async with Fleet(announce=news.append) as fleet:
            fleet.attach(link)
            (found,) = await fleet.wait_for([4], PATIENCE_S)
            assert link._transport is not None
            link._transport.abort()
            async with asyncio.timeout(PATIENCE_S):
                while len(news) < 2:
                    await asyncio.sleep(0.01)
            await set_mode(found, Mode.LOITER)

    run(main())
    assert [line.rpartition(": ")[2] for line in news] == ["connection lost", "connected"]
