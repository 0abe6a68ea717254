"""One endpoint: a simulated vehicle's process. Free of numba, scipy and pydantic, so that nine of them start fast."""

import contextlib
import math
import os
import signal
import threading
import time
import traceback
from collections.abc import Iterator
from dataclasses import dataclass
from multiprocessing.connection import Connection
from pathlib import Path

from zenoh import ZError

from missions.errors import InputError
from sitl.clock import Clock, serve_clock
from sitl.config import VehicleConfig
from sitl.ending import Ending
from sitl.events import StatusText
from sitl.formation.exchange import Exchange
from sitl.services.face import MavlinkFace
from sitl.services.links import StationLinks
from sitl.services.signing import Signing
from sitl.store import Store
from sitl.ticks import TICK_S
from sitl.truth import TruthWriter
from sitl.vehicle import Vehicle
from sitl.zenoh_session import Peer, alive_key, discard_sockets, open_session

NEIGHBOURS_TIMEOUT_S = 30.0
SEVERITY_WARNING = 4
"""MAV_SEVERITY_WARNING."""


@dataclass(frozen=True)
class EndpointConfig:
    """One endpoint.

    Attributes:
        vehicle: what flies.
        swarm: the name in the swarm's Zenoh keys.
        peer: where its Zenoh session listens and connects.
        stations: (host, port) that telemetry goes to over UDP.
        tcp_port: of its TCP server; 0 for a free one.
        truth: the file for its truth; None keeps none.
        memory: the folder of what it remembers over restarts; None forgets.
        held: whether its clock starts held.
        speed: factor of its clock; infinite for as fast as it goes.
        signing_key: its MAVLink key of 32 bytes until it is given another; None for none.
    """

    vehicle: VehicleConfig
    swarm: str
    peer: Peer
    stations: tuple[tuple[str, int], ...]
    tcp_port: int
    truth: Path | None
    memory: Path | None
    held: bool
    speed: float = math.inf
    signing_key: bytes | None = None


@dataclass(frozen=True)
class Ready:
    """First report of an endpoint: it answers at these ports."""

    tcp_port: int
    udp_port: int


@dataclass(frozen=True)
class Ended:
    """Last report of an endpoint whose clock was stopped: at which tick, and how many messages were no samples."""

    tick: int
    rejected_samples: int


@dataclass(frozen=True)
class Failed:
    """Last report of an endpoint that cannot go on, and why."""

    reason: str


Report = Ready | Ended | Failed


def run_endpoint(config: EndpointConfig, reports: Connection) -> None:
    """Run a vehicle until its clock is stopped, it is told to terminate, or the station that started it has gone."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C hits the whole group; the station stops us

    def end_at_once() -> None:
        discard_sockets(config.peer)
        os._exit(1)

    ending = Ending(end_at_once)
    try:
        last: Report = _serve(config, reports, ending)
    except Exception as error:  # whatever it was, the station is to know why it lost a vehicle
        if not isinstance(error, InputError | OSError | ZError):
            traceback.print_exc()
        last = Failed(f"vehicle {config.vehicle.sysid}: {str(error) or type(error).__name__}")
    discard_sockets(config.peer)
    with contextlib.suppress(OSError):
        reports.send(last)


def _serve(config: EndpointConfig, reports: Connection, ending: Ending) -> Ended:
    """Open everything, fly, close everything."""
    sysid = config.vehicle.sysid
    truth = TruthWriter(config.truth)
    store = Store(config.memory)
    vehicle = Vehicle(config.vehicle, truth, store)
    with (
        contextlib.closing(truth),
        contextlib.closing(StationLinks(config.tcp_port, config.stations)) as links,
        open_session(config.peer) as session,
    ):
        face = MavlinkFace(
            vehicle, config.vehicle.frame, links.send, time.monotonic, Signing(store, config.signing_key)
        )
        links.attach(face)
        exchange = Exchange(session, config.swarm, sysid, config.vehicle.weights)
        clock = Clock(held=config.held, speed=config.speed, on_stop=exchange.stop)
        ending.stop = clock.stop
        serve_clock(session, config.swarm, sysid, clock)
        alive = session.liveliness().declare_token(alive_key(config.swarm, sysid))
        if missing := exchange.wait_for_neighbours(NEIGHBOURS_TIMEOUT_S):
            raise InputError(f"heard nothing of vehicles {sorted(missing)} over Zenoh")

        face.on_simulated_tick(vehicle.snapshot())  # stations may look at a held vehicle
        with _serving(links, clock):
            reports.send(Ready(links.tcp_port, links.udp_port))
            _fly(vehicle, face, exchange, clock, config.vehicle.delay_ticks)
        alive.undeclare()
        return Ended(vehicle.tick, exchange.rejected)


@contextlib.contextmanager
def _serving(links: StationLinks, clock: Clock) -> Iterator[None]:
    """Within this context a thread serves the stations; an error there stops the clock, and is raised at the end."""
    stopped = threading.Event()
    errors: list[Exception] = []

    def serve() -> None:
        try:
            links.run(stopped)
        except Exception as error:
            errors.append(error)
            clock.stop()

    thread = threading.Thread(target=serve, name="mavlink")
    thread.start()
    try:
        yield
    finally:
        stopped.set()
        links.stop_waiting()
        thread.join()
    if errors:
        raise errors[0]


def _fly(vehicle: Vehicle, face: MavlinkFace, exchange: Exchange, clock: Clock, delay_ticks: int) -> None:
    """Tick by tick until the clock is stopped."""
    lost: set[int] = set()
    while clock.wait_for(vehicle.tick):
        with vehicle.lock:
            own = vehicle.observe()
        # A neighbour needs a sample only `delay_ticks` later: as fast as it goes, that many share a message.
        exchange.publish(own, now=clock.paced or (own.tick + 1) % delay_ticks == 0)
        heard = exchange.gather(own.tick - delay_ticks)
        if clock.stopped:
            return
        with vehicle.lock:
            for sysid in exchange.gone - lost:
                lost.add(sysid)
                vehicle.report(StatusText(SEVERITY_WARNING, f"Neighbour {sysid} lost, flying on"))
            vehicle.advance(heard)
            if face.wants(vehicle.tick * TICK_S):
                face.on_simulated_tick(vehicle.snapshot())
