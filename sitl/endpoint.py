"""One endpoint: a simulated vehicle with its MAVLink face and sockets. Free of numba, scipy and pydantic, so that nine
of them start fast."""

import time
from collections.abc import Iterable, Mapping, Set
from dataclasses import dataclass
from pathlib import Path

from missions.reassignment import Loss
from sitl.avoidance.avoider import Heard
from sitl.avoidance.intent import Intent
from sitl.avoidance.yielding import Yielding
from sitl.config import VehicleConfig
from sitl.events import StatusText
from sitl.formation.correction import Correction
from sitl.formation.disturbance import Disturbance
from sitl.formation.failures import FOR_EVER
from sitl.formation.link_report import LinkReport
from sitl.formation.link_state import LinkState
from sitl.services.face import MavlinkFace
from sitl.services.links import StationLinks
from sitl.services.signing import Signing
from sitl.store import Store
from sitl.ticks import TICK_S
from sitl.truth import TruthWriter
from sitl.vehicle import Vehicle

SEVERITY_WARNING, SEVERITY_NOTICE = 4, 5
"""MAV_SEVERITY_WARNING, MAV_SEVERITY_NOTICE."""


@dataclass(frozen=True)
class EndpointConfig:
    """One endpoint.

    Attributes:
        vehicle: what flies.
        stations: (host, port) that telemetry goes to over UDP.
        tcp_port: of its TCP server; 0 for a free one.
        truth: the file for its truth; None keeps none.
        memory: the folder of what it remembers over restarts; None forgets.
        signing_key: its MAVLink key of 32 bytes until it is given another; None for none.
        start_tick: of its simulated time.
    """

    vehicle: VehicleConfig
    stations: tuple[tuple[str, int], ...] = ()
    tcp_port: int = 0
    truth: Path | None = None
    memory: Path | None = None
    signing_key: bytes | None = None
    start_tick: int = 0


class Endpoint:
    """A vehicle, steppable by one thread while another serves its `links`.

    Raises:
        InputError: its TCP port cannot be had, or what it remembers cannot be read.
        OSError: its truth cannot be written.

    Attributes:
        delays: the least delay in ticks of each of those it flies in formation with, by sysid.
        death_tick: when it is to fail.
        real_time: nobody waits for anybody.
        links: its sockets; they want to be served.
        face: what they are served for.
    """

    def __init__(self, config: EndpointConfig) -> None:
        self.sysid = config.vehicle.sysid
        self._network = network = config.vehicle.network
        self.delays = self._delays_of(network.neighbours(self.sysid))
        self.death_tick = network.deaths.get(self.sysid, FOR_EVER)
        self.real_time = config.vehicle.real_time
        self._truth = TruthWriter(config.truth, shifts=config.vehicle.swarm_clock)
        store = Store(config.memory)
        self._vehicle = Vehicle(config.vehicle, self._truth, store)
        self._vehicle.tick = config.start_tick
        self.links = StationLinks(config.tcp_port, config.stations)
        signing = Signing(store, config.signing_key)
        self.face = MavlinkFace(self._vehicle, config.vehicle.frame, self.links.send, time.monotonic, signing)
        self.links.attach(self.face)
        self.face.on_simulated_tick(self._vehicle.snapshot())  # stations may look at a held vehicle

    @property
    def tick(self) -> int:
        """Simulated time."""
        return self._vehicle.tick

    def observe(self) -> Correction:
        """Begin a tick; returns the own deviation, for the neighbours."""
        with self._vehicle.lock:
            return self._vehicle.observe()

    def intent(self) -> Intent:
        """What to tell all others of this tick, after `observe`."""
        with self._vehicle.lock:
            return self._vehicle.intent()

    def learn(self, heard: Heard, lost: Set[int]) -> None:
        """Take in what the others intend, after `observe`; and fly on without those who are lost."""
        with self._vehicle.lock:
            self._vehicle.learn(heard, lost)

    def advance(self, heard: Mapping[int, Correction]) -> None:
        """End a tick with the deviations of (at least) the neighbours, and tell the stations what is due."""
        vehicle = self._vehicle
        with vehicle.lock:
            vehicle.advance(heard)
            if self.face.wants(vehicle.tick * TICK_S):
                self.face.on_simulated_tick(vehicle.snapshot())

    def notice(self, lost: Set[int], before: Set[int]) -> None:
        """Fly on without those who are lost, and with those who are back: the graph is mended, the stations are told.

        Args:
            lost, before: who is lost, and who was.
        """
        with self._vehicle.lock:
            for sysid in sorted((lost - before) & self.delays.keys()):
                self._vehicle.report(StatusText(SEVERITY_WARNING, f"Neighbour {sysid} lost, flying on"))
            for sysid in sorted((before - lost) & self.delays.keys()):
                self._vehicle.report(StatusText(SEVERITY_NOTICE, f"Neighbour {sysid} is back"))
            for sysid in sorted(self._vehicle.lose(lost) - self.delays.keys()):
                self._vehicle.report(StatusText(SEVERITY_NOTICE, f"Vehicle {sysid} is a neighbour now"))
                self.delays |= self._delays_of([sysid])

    def know(self, links: tuple[LinkReport, ...], wrong: Iterable[str]) -> None:
        """Tell the stations what has come of the links to it, and what is newly wrong with them, a line each."""
        with self._vehicle.lock:
            self._vehicle.links = links
            for line in wrong:
                self._vehicle.report(StatusText(SEVERITY_WARNING, line))

    def disturb(self, delay_ticks: int, loss: float, from_tick: int | None) -> int:
        """Add delay and loss to its links; see `Vehicle.disturb`."""
        with self._vehicle.lock:
            return self._vehicle.disturb(delay_ticks, loss, from_tick)

    def network_state(self) -> tuple[int, Disturbance, tuple[LinkState, ...]]:
        """The tick to come, the disturbance in force and how its links stand, of one moment."""
        with self._vehicle.lock:
            return self._vehicle.tick, self._vehicle.disturbance, self._vehicle.link_states()

    def count_lost(self, loss: Loss) -> None:
        """All have agreed on a loss."""
        with self._vehicle.lock:
            self._vehicle.count_lost(loss)

    def losses(self) -> tuple[Loss, ...]:
        """Those that all have agreed on so far."""
        return self._vehicle.losses()

    def edges(self) -> tuple[tuple[int, int, bool], ...]:
        """(tick, neighbour, whether its edge counted from then on), of each change so far."""
        return self._vehicle.edges()

    def yieldings(self) -> tuple[Yielding, ...]:
        """Who was given way to so far."""
        return self._vehicle.yieldings()

    def _delays_of(self, neighbours: Iterable[int]) -> dict[int, int]:
        return {other: self._network.channel_of(other, self.sysid).delay_ticks for other in neighbours}

    def close(self) -> None:
        """Bring the truth to the disk. Raises OSError when it does not fit."""
        self._truth.close()
