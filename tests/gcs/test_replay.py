"""Logs played back over real links, on loopback."""

import asyncio
import socket
from pathlib import Path

import pytest
from pymavlink.dialects.v20 import ardupilotmega as mavlink
from typer.testing import CliRunner

from gcs import station
from gcs.cli import app
from gcs.fleet import Fleet
from gcs.links.open_link import open_link
from gcs.links.tcp_server import TcpServerLink
from gcs.links.udp import UdpLink
from gcs.replay import read_replay, replay
from gcs.tlog import TelemetryLog
from missions.errors import InputError
from sitl.services.codec import Codec

LOOPBACK = "127.0.0.1"
PATIENCE_S = 10.0


def write_log(folder: Path, sysid: int, seconds: int = 20) -> Path:
    path, vehicle, ours = folder / f"{sysid}.tlog", Codec(sysid, 1), Codec(station.SYSID, station.COMPID)
    log = TelemetryLog(path, 1_700_000_000.0)
    log.write(0, ours.pack(mavlink.MAVLink_setup_signing_message(sysid, 1, bytes(range(32)), 1)))
    for second in range(seconds):
        log.write(1000 * second, ours.pack(station.heartbeat()))
        log.write(1000 * second, vehicle.pack(mavlink.MAVLink_heartbeat_message(1, 3, 81, 10, 3, 3)))
        log.write(1000 * second, vehicle.pack(mavlink.MAVLink_system_time_message(0, 1000 * second)))
    log.close()
    return path


def test_only_what_vehicles_said_is_played_in_the_order_of_time(tmp_path: Path) -> None:
    messages = read_replay([write_log(tmp_path, sysid) for sysid in (3, 4)])
    assert len(messages) == 80
    assert {one.message.get_srcSystem() for one in messages} == {3, 4}
    assert [one.time_s for one in messages] == sorted(one.time_s for one in messages)


def test_a_station_sees_the_flight_once_more(tmp_path: Path) -> None:
    messages = read_replay([write_log(tmp_path, sysid) for sysid in (3, 4)])

    async def main() -> None:
        listening = await UdpLink.open()
        async with Fleet() as fleet:
            fleet.attach(listening)
            out = await open_link(f"udpout://{LOOPBACK}:{listening.port}")
            assert await replay(messages, out, 1e6) == 80
            async with asyncio.timeout(PATIENCE_S):
                found = await fleet.wait_for([3, 4], PATIENCE_S)
                while any(vehicle.frames < 40 for vehicle in found):
                    await asyncio.sleep(0)
            assert [vehicle.simulated_ms for vehicle in found] == [19_000, 19_000]
            assert [vehicle.lost_frames for vehicle in found] == [0, 0]
            await out.close()

    asyncio.run(main())


@pytest.mark.parametrize("speed", [1.0, 10.0])
def test_it_keeps_the_pace_of_the_stamps(tmp_path: Path, speed: float) -> None:
    messages = read_replay([write_log(tmp_path, 3)])
    waits_s: list[float] = []

    def now() -> float:
        return 50.0 + sum(waits_s)

    async def sleep(seconds: float) -> None:
        waits_s.append(seconds)

    async def main() -> None:
        with socket.socket(type=socket.SOCK_DGRAM) as receiver:
            receiver.bind((LOOPBACK, 0))
            link = await UdpLink.connect(*receiver.getsockname())
            await replay(messages, link, speed, now, sleep)
            await link.close()

    asyncio.run(main())
    assert waits_s == pytest.approx([1.0 / speed] * 19)


def test_a_station_that_connects_gets_it_from_the_start(tmp_path: Path) -> None:
    messages = read_replay([write_log(tmp_path, 3)])

    async def main() -> None:
        link = await TcpServerLink.open()
        playing = asyncio.create_task(replay(messages, link, 1e6))
        reader, writer = await asyncio.open_connection(LOOPBACK, link.port)
        got = b"".join(one.message.get_msgbuf() for one in messages)
        async with asyncio.timeout(PATIENCE_S):
            assert await reader.readexactly(len(got)) == got
        await playing
        writer.close()
        await link.close()

    asyncio.run(main())


def test_the_command_plays_and_counts(tmp_path: Path) -> None:
    with socket.socket(type=socket.SOCK_DGRAM) as receiver:
        receiver.bind((LOOPBACK, 0))
        url = f"udpout://{LOOPBACK}:{receiver.getsockname()[1]}"
        result = CliRunner().invoke(app, ["replay", str(write_log(tmp_path, 3)), "--to", url, "--speed", "100000"])
        assert result.exit_code == 0
        assert "40 frames sent" in result.stdout
        receiver.settimeout(PATIENCE_S)
        (message, *_) = Codec(255, 190).feed(receiver.recv(65536))
    assert message.get_type() == "HEARTBEAT"


def test_a_log_of_stations_only_is_an_input_error(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"3\.tlog: no vehicle in it"):
        read_replay([write_log(tmp_path, 3, seconds=0)])
