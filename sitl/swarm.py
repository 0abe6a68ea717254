"""A swarm of endpoints as processes of this machine: started together, looked after, ended together."""

import math
import multiprocessing
import signal
import time
import uuid
from dataclasses import dataclass
from multiprocessing.connection import Connection, wait
from multiprocessing.context import ForkServerProcess
from pathlib import Path
from types import TracebackType

from missions.errors import InputError
from missions.scenario import Scenario
from sitl.config import Arm, VehicleConfig
from sitl.endpoint import Ended, EndpointConfig, Failed, Ready, Report, run_endpoint
from sitl.formation.graph import edges, neighbour_weights
from sitl.formation.law import Gains
from sitl.ticks import delay_ticks
from sitl.zenoh_session import Peer, discard_sockets, local_peers

START_TIMEOUT_S = 60.0
END_TIMEOUT_S = 5.0


@dataclass(frozen=True)
class SwarmOptions:
    """How a scenario's vehicles are simulated.

    Attributes:
        seed: of the gusts.
        delay_s: of the corrections; rounded up to whole ticks.
        arm: how much of the formation law is on.
        held: whether the clocks start held.
        speed: factor of the clocks; infinite for as fast as they go.
        stations: (host, port) that telemetry goes to over UDP.
        tcp_port: of the first vehicle, 10 more each for the others; 0 for free ones.
        truth: folder for the truth files; None keeps none.
        memory: folder of what the vehicles remember over restarts, one each in it; None forgets.
    """

    seed: int
    delay_s: float
    arm: Arm = "full"
    held: bool = True
    speed: float = math.inf
    stations: tuple[tuple[str, int], ...] = ()
    tcp_port: int = 0
    truth: Path | None = None
    memory: Path | None = None


@dataclass
class Endpoint:
    """One endpoint's process, seen from the station."""

    sysid: int
    process: ForkServerProcess
    reports: Connection
    ready: Ready | None = None
    last: Ended | Failed | None = None

    def read_reports(self) -> None:
        """Take what the process has reported so far."""
        try:
            while self.reports.poll():
                self._take(self.reports.recv())
        except (EOFError, OSError):
            pass

    def _take(self, report: Report) -> None:
        if isinstance(report, Ready):
            self.ready = report
        else:
            self.last = report

    def obituary(self) -> str | None:
        """Why the vehicle was lost; None while its process runs. Not to be asked once the clock was told to stop."""
        self.read_reports()
        if isinstance(self.last, Failed):
            return self.last.reason
        if isinstance(self.last, Ended):
            return f"process ended at tick {self.last.tick}, though nobody had stopped its clock"
        if self.process.is_alive():
            return None
        code = self.process.exitcode or 0
        return f"process killed by {signal.Signals(-code).name}" if code < 0 else f"process ended with code {code}"


class Swarm:
    """Endpoints, running. A context manager: at its end nothing is left running.

    Args:
        scenario: whose vehicles they are.
        options: how they are simulated.

    Raises:
        InputError: an endpoint could not start; the message says which and why.
    """

    def __init__(self, scenario: Scenario, options: SwarmOptions) -> None:
        self.name = uuid.uuid4().hex[:8]
        vehicles = vehicle_configs(scenario, options)
        self._peers, self.station_peer = local_peers({vehicle.sysid: vehicle.weights for vehicle in vehicles})
        context = multiprocessing.get_context("forkserver")
        context.set_forkserver_preload(["sitl.endpoint"])
        self.endpoints: dict[int, Endpoint] = {}
        try:
            for i, vehicle in enumerate(vehicles):
                config = self._endpoint_config(i, vehicle, self._peers[vehicle.sysid], options)
                reports, child_end = context.Pipe(duplex=False)
                process = context.Process(
                    target=run_endpoint, args=(config, child_end), name=f"skein-{vehicle.sysid}", daemon=True
                )
                process.start()
                child_end.close()
                self.endpoints[vehicle.sysid] = Endpoint(vehicle.sysid, process, reports)
            self._wait_until_ready()
        except BaseException:
            self.end()
            raise

    def _endpoint_config(self, i: int, vehicle: VehicleConfig, peer: Peer, options: SwarmOptions) -> EndpointConfig:
        return EndpointConfig(
            vehicle=vehicle,
            swarm=self.name,
            peer=peer,
            stations=options.stations,
            tcp_port=options.tcp_port + 10 * i if options.tcp_port else 0,
            truth=options.truth / f"{vehicle.sysid}.f64" if options.truth else None,
            memory=options.memory / str(vehicle.sysid) if options.memory else None,
            held=options.held,
            speed=options.speed,
        )

    def _wait_until_ready(self) -> None:
        deadline = time.monotonic() + START_TIMEOUT_S
        while starting := [e for e in self.endpoints.values() if e.ready is None]:
            wait([e.reports for e in starting], timeout=1.0)
            for endpoint in starting:
                if reason := endpoint.obituary():
                    raise InputError(reason)
            if time.monotonic() > deadline:
                raise InputError(f"vehicles {[e.sysid for e in starting]} did not start within {START_TIMEOUT_S:.0f} s")

    def end(self) -> None:
        """End all processes: by request, then by force."""
        for endpoint in self.endpoints.values():
            endpoint.process.terminate()
        deadline = time.monotonic() + END_TIMEOUT_S
        for endpoint in self.endpoints.values():
            endpoint.process.join(max(0.0, deadline - time.monotonic()))
            if endpoint.process.is_alive():
                endpoint.process.kill()
                endpoint.process.join()
            endpoint.read_reports()
            endpoint.reports.close()
        for peer in self._peers.values():  # who was killed could not do it
            discard_sockets(peer)

    def __enter__(self) -> "Swarm":
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.end()


def vehicle_configs(scenario: Scenario, options: SwarmOptions) -> list[VehicleConfig]:
    """What each vehicle of a scenario is told at its start."""
    formation, wind = scenario.formation, scenario.wind
    graph = edges(formation.graph, [vehicle.sysid for vehicle in scenario.vehicles])
    return [
        VehicleConfig(
            sysid=vehicle.sysid,
            name=vehicle.name,
            frame=scenario.frame,
            home_m=scenario.origin_m(vehicle),
            airframe=scenario.airframe.airframe(),
            terrain=scenario.environment.terrain,
            seed=options.seed,
            steady_wind_m_s=wind.steady_m_s,
            forecast_wind_m_s=wind.forecast_m_s,
            gusts=wind.gusts,
            gains=Gains(formation.k1, formation.k2, formation.k3, formation.k0),
            weights=neighbour_weights(vehicle.sysid, graph),
            delay_ticks=delay_ticks(options.delay_s),
            arm=options.arm,
        )
        for vehicle in scenario.vehicles
    ]
