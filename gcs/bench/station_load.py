"""How many vehicles one station process can listen to: a thousand of them, from another process, over UDP.

A MAVLink network has 254 system ids for vehicles, so more of them are several networks: a port and a fleet each.
"""

import asyncio
import contextlib
import multiprocessing
import resource
import socket
import time
from collections.abc import Sequence
from dataclasses import dataclass
from multiprocessing.connection import Connection
from pathlib import Path

from pymavlink.dialects.v20 import ardupilotmega as mavlink

from gcs.fleet import Fleet
from gcs.links.udp import UdpLink
from gcs.tlog import TelemetryLog
from sitl.services.codec import Codec
from sitl.services.links import LOOPBACK
from sitl.services.peer import Message

VEHICLES_A_FLEET = 250
_SEQUENCE = 256
"""Sequence numbers there are: so many frames are packed beforehand, and sent again and again."""
_PATIENCE_S = 1.0
"""What has not come so long after the last frame was sent is lost."""
_LOOK_S = 0.01


@dataclass(frozen=True)
class Load:
    """What is sent to the station.

    Attributes:
        vehicles: how many.
        rate_hz: messages a second of each.
        frames: in a datagram; a divisor of 256.
        seconds: how long.
    """

    vehicles: int = 1000
    rate_hz: float = 100.0
    frames: int = 8
    seconds: float = 10.0


@dataclass(frozen=True)
class Listened:
    """What became of it.

    Attributes:
        sent, received: frames.
        lost: frames missing from the vehicles' sequence numbers.
        heard: vehicles.
        seconds: wall time from the first frame to the last.
        core: processor time of the station's process, as a fraction of one core.
    """

    sent: int
    received: int
    lost: int
    heard: int
    seconds: float
    core: float

    @property
    def us_a_frame(self) -> float:
        """Processor time of the station's process for a frame, in microseconds."""
        return self.core * self.seconds / max(1, self.received) * 1e6


async def listen(load: Load, logs: Path | None = None) -> Listened:
    """Send a load from another process, and listen to it in this one.

    Args:
        load: what is sent.
        logs: an existing folder for a log of each vehicle; None keeps none.
    """
    context = multiprocessing.get_context("spawn")
    ours, theirs = context.Pipe()
    async with contextlib.AsyncExitStack() as stack:
        fleets, ports = [], []
        for number in range(-(-load.vehicles // VEHICLES_A_FLEET)):
            link = await UdpLink.open()
            fleet = await stack.enter_async_context(Fleet(_logs_in(logs, number)))
            fleet.attach(link)
            fleets.append(fleet)
            ports.append(link.port)
        sender = context.Process(target=_send, args=(load, ports, theirs), daemon=True)
        sender.start()
        try:
            await asyncio.to_thread(ours.recv)  # packed, ready to send
            before_s, began_s = _processor_s(), time.monotonic()
            ours.send(None)
            sent: int = await asyncio.to_thread(ours.recv)
            deadline_s = time.monotonic() + _PATIENCE_S
            while _frames(fleets) < sent and time.monotonic() < deadline_s:
                await asyncio.sleep(_LOOK_S)
            seconds, core_s = time.monotonic() - began_s, _processor_s() - before_s
        finally:
            sender.terminate()
            await asyncio.to_thread(sender.join)
        vehicles = [vehicle for fleet in fleets for vehicle in fleet.vehicles.values()]
        lost = sum(one.lost_frames for one in vehicles)
        return Listened(sent, _frames(fleets), lost, len(vehicles), seconds, core_s / seconds)


def _logs_in(folder: Path | None, number: int) -> "_OpenLog | None":
    return None if folder is None else _OpenLog(folder, number)


@dataclass(frozen=True)
class _OpenLog:
    """Opens the logs of one fleet's vehicles."""

    folder: Path
    number: int

    def __call__(self, sysid: int) -> TelemetryLog:
        return TelemetryLog(self.folder / f"{self.number}-{sysid}.tlog", time.time())


def _frames(fleets: Sequence[Fleet]) -> int:
    return sum(vehicle.frames for fleet in fleets for vehicle in fleet.vehicles.values())


def _processor_s() -> float:
    usage = resource.getrusage(resource.RUSAGE_SELF)
    return usage.ru_utime + usage.ru_stime


def _send(load: Load, ports: Sequence[int], report: Connection) -> None:
    """The other process: all vehicles, a socket each."""
    wanted = load.vehicles + 64
    soft, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
    if soft < wanted:
        resource.setrlimit(resource.RLIMIT_NOFILE, (wanted, hard))
    vehicles = [_Sender(number, load, ports[number // VEHICLES_A_FLEET]) for number in range(load.vehicles)]
    report.send(None)
    report.recv()
    began_s = time.monotonic()
    period_s = load.frames / load.rate_hz
    turns = round(load.seconds / period_s) * load.vehicles
    for turn in range(turns):
        wait_s = began_s + turn * period_s / load.vehicles - time.monotonic()
        if wait_s > 0.0:
            time.sleep(wait_s)
        vehicles[turn % load.vehicles].send(turn // load.vehicles)
    report.send(turns * load.frames)
    report.recv()


class _Sender:
    """One vehicle: its datagrams, packed, and its socket."""

    def __init__(self, number: int, load: Load, port: int) -> None:
        codec = Codec(number % VEHICLES_A_FLEET + 1, mavlink.MAV_COMP_ID_AUTOPILOT1)
        period_ms = 1000.0 / load.rate_hz
        frames = [codec.pack(_message(seq, round(seq * period_ms))) for seq in range(_SEQUENCE)]
        starts = range(0, _SEQUENCE, load.frames)
        self._datagrams = [b"".join(frames[start : start + load.frames]) for start in starts]
        self._socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self._socket.connect((LOOPBACK, port))

    def send(self, turn: int) -> None:
        self._socket.send(self._datagrams[turn % len(self._datagrams)])


def _message(number: int, time_ms: int) -> Message:
    """What a vehicle streams: attitude and position most of all, a heartbeat now and then."""
    if number % 64 == 0:
        return mavlink.MAVLink_heartbeat_message(1, 3, 217, 10, 4, 3)
    match number % 8:
        case 1 | 5:
            return mavlink.MAVLink_attitude_message(time_ms, 0.1, 0.02, 1.5, 0.01, 0.02, 0.03)
        case 2 | 6:
            return mavlink.MAVLink_global_position_int_message(
                time_ms, 465_000_000, 113_000_000, 1_500_000, 300_000, 2000, 100, -5, 9000
            )
        case 3:
            return mavlink.MAVLink_vfr_hud_message(22.0, 23.0, 90, 50, 1500.0, 0.1)
        case 4:
            return mavlink.MAVLink_local_position_ned_message(time_ms, 1.0, 2.0, -300.0, 20.0, 1.0, 0.1)
        case 7:
            return mavlink.MAVLink_nav_controller_output_message(1.0, 2.0, 90, 91, 400, 0.5, 0.1, 3.0)
    return mavlink.MAVLink_named_value_float_message(time_ms, b"form_err", 3.0)
