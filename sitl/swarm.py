"""A swarm of endpoints as processes of this machine: started together, looked after, ended together."""

import math
import os
import selectors
import time
import uuid
from dataclasses import dataclass, replace
from multiprocessing.connection import wait
from multiprocessing.process import BaseProcess
from pathlib import Path
from types import TracebackType

from missions.errors import InputError
from missions.reassignment import Reassign
from missions.scenario import Scenario
from sitl.child import Endpoint, EndpointProcess, hatch
from sitl.config import Arm, VehicleConfig
from sitl.endpoint import EndpointConfig
from sitl.formation.vehicle_gains import vehicle_gains
from sitl.process import ProcessConfig
from sitl.scenario_network import network_of
from sitl.stands import stands
from sitl.zenoh_network import STATION, ZenohNetwork, vehicle_name
from sitl.zenoh_session import Peer, discard_sockets, local_peers, make_socket_folder

START_TIMEOUT_S = 60.0
END_TIMEOUT_S = 5.0
MOST_PROCESSES = 24
"""Larger swarms share processes, as many as there are cores, unless told otherwise."""
MOST_IN_A_NEST = 100
"""Vehicles, unless they are of one process: the sockets of all are open in it until it has forked them."""


@dataclass(frozen=True)
class SwarmOptions:
    """How a scenario's vehicles are simulated.

    Attributes:
        seed: of the gusts.
        delay_s: of the corrections; rounded up to whole ticks.
        arm: how much of the formation law is on.
        held: whether the clocks start held.
        speed: factor of the clocks; infinite for as fast as they go.
        real_time: the clocks are the wall's, held until they are released together, and nobody waits for anybody; in
            lockstep otherwise.
        stations: (host, port) that telemetry goes to over UDP.
        tcp_port: of the first vehicle, 10 more each for the others; 0 for free ones.
        truth: folder for the truth files; None keeps none.
        memory: folder of what the vehicles remember over restarts, one each in it; None forgets.
        signing_key: the vehicles' MAVLink key of 32 bytes until they are given another; None for none.
        count: of vehicles, when not the scenario's (see `stands`).
        sysid_base: system id of the first vehicle, when not the scenario's.
        per_process: vehicles that share a process; None chooses.
        zenoh: how vehicles on several machines meet; None for all on this one.
        here: system ids of the vehicles that run on this machine; None for all.
        reassign: of the plan that is flown, where places are reassigned; None where they are not.
    """

    seed: int
    delay_s: float
    arm: Arm = "full"
    held: bool = True
    speed: float = math.inf
    real_time: bool = False
    stations: tuple[tuple[str, int], ...] = ()
    tcp_port: int = 0
    truth: Path | None = None
    memory: Path | None = None
    signing_key: bytes | None = None
    count: int | None = None
    sysid_base: int | None = None
    per_process: int | None = None
    zenoh: ZenohNetwork | None = None
    here: frozenset[int] | None = None
    reassign: Reassign | None = None


class Swarm:
    """Endpoints, running. A context manager: at its end nothing is left running.

    Args:
        scenario: whose vehicles they are.
        options: how they are simulated.

    Attributes:
        sysids: of the whole swarm, on whatever machine.
        endpoints: those on this machine.

    Raises:
        InputError: an endpoint could not start; the message says which and why.
    """

    def __init__(self, scenario: Scenario, options: SwarmOptions) -> None:
        self._options = options
        self.name = options.zenoh.swarm if options.zenoh else uuid.uuid4().hex[:8]
        everyone = vehicle_configs(scenario, options)
        self.sysids = tuple(vehicle.sysid for vehicle in everyone)
        endpoints = [
            _endpoint_config(i, vehicle, options)
            for i, vehicle in enumerate(everyone)
            if options.here is None or vehicle.sysid in options.here
        ]
        if options.here and (unknown := options.here - set(self.sysids)):
            raise InputError(f"vehicles {sorted(unknown)}: not in this swarm; it has {list(self.sysids)}")
        size = 1 if options.zenoh else per_process(options.per_process, len(endpoints))
        groups = [tuple(endpoints[i : i + size]) for i in range(0, len(endpoints), size)]
        if options.zenoh:
            self._peers = {i: options.zenoh.client(vehicle_name(one.vehicle.sysid)) for i, (one,) in enumerate(groups)}
        else:
            self._peers, self._station_peer = local_peers(range(len(groups)))
        self._processes: list[EndpointProcess] = []
        self._nests: list[BaseProcess] = []
        self.endpoints: dict[int, Endpoint] = {}
        try:
            self._start(
                [
                    ProcessConfig(
                        group,
                        self.name,
                        self._peers[i],
                        held=options.held or options.real_time,
                        speed=options.speed,
                        real_time=options.real_time,
                    )
                    for i, group in enumerate(groups)
                ]
            )
        except BaseException:
            self.end()
            raise

    @property
    def station_peer(self) -> Peer:
        """Session of a station that goes by the swarm's clocks. Raises InputError when its certificate is no use."""
        return self._options.zenoh.client(STATION) if self._options.zenoh else self._station_peer

    def restart(self, sysid: int, tick: int = 0) -> None:
        """Start the ended process of a vehicle again, and with it those that share it; they remember what they had.

        Their neighbours, who have flown on without them, wait for them again.

        Args:
            sysid: of the vehicle.
            tick: simulated time at which they begin, near to that of the others.

        Raises:
            InputError: they could not start.
        """
        old = self.endpoints[sysid].process
        old.terminate()
        old.end(time.monotonic() + END_TIMEOUT_S)
        self._processes.remove(old)
        make_socket_folder(old.config.peer)
        endpoints = tuple(replace(endpoint, start_tick=tick) for endpoint in old.config.endpoints)
        self._start([replace(old.config, endpoints=endpoints)])

    def _start(self, configs: list[ProcessConfig]) -> None:
        started: list[EndpointProcess] = []
        per_nest = max(1, MOST_IN_A_NEST // len(configs[0].endpoints))
        for i in range(0, len(configs), per_nest):
            processes, nest = hatch(configs[i : i + per_nest])
            started += processes
            self._processes += processes
            self._nests.append(nest)
        for process in started:
            for one in process.config.endpoints:
                self.endpoints[one.vehicle.sysid] = Endpoint(one.vehicle.sysid, one.vehicle.name, process)
        self._wait_until_ready(started)

    def _wait_until_ready(self, processes: list[EndpointProcess]) -> None:
        deadline = time.monotonic() + START_TIMEOUT_S
        while starting := [process for process in processes if process.starting]:
            wait([process.reports for process in starting], timeout=1.0)
            missing = [e for e in self.endpoints.values() if e.process in starting and e.ready is None]
            for endpoint in missing:
                if reason := endpoint.obituary():
                    raise InputError(reason)
            if time.monotonic() > deadline:
                raise InputError(f"vehicles {[e.sysid for e in missing]} did not start within {START_TIMEOUT_S:.0f} s")

    def end(self) -> None:
        """End all processes: by request, then by force."""
        for process in self._processes:
            process.terminate()
        deadline = time.monotonic() + END_TIMEOUT_S
        for process in self._processes:
            process.end(deadline)
        for nest in self._nests:
            nest.join()
        for peer in self._peers.values():  # who was killed could not do it
            discard_sockets(peer)

    def __enter__(self) -> "Swarm":
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.end()


def per_process(asked: int | None, count: int) -> int:
    """How many of `count` vehicles share a process.

    Raises:
        InputError: several were asked for, and this platform cannot serve the sockets of several.
    """
    able = hasattr(selectors.DefaultSelector, "fileno")
    if asked is not None:
        if asked > 1 and not able:
            raise InputError(f"--per-process {asked}: this platform takes one vehicle a process")
        return asked
    if count <= MOST_PROCESSES or not able:
        return 1
    return math.ceil(count / (os.cpu_count() or 1))


def _endpoint_config(i: int, vehicle: VehicleConfig, options: SwarmOptions) -> EndpointConfig:
    return EndpointConfig(
        vehicle=vehicle,
        stations=options.stations,
        tcp_port=options.tcp_port + 10 * i if options.tcp_port else 0,
        truth=options.truth / f"{vehicle.sysid}.f64" if options.truth else None,
        memory=options.memory / str(vehicle.sysid) if options.memory else None,
        signing_key=options.signing_key,
    )


def vehicle_configs(scenario: Scenario, options: SwarmOptions) -> list[VehicleConfig]:
    """What each vehicle of a scenario is told at its start."""
    formation, wind = scenario.formation, scenario.wind
    everyone = stands(scenario, options.count, options.sysid_base)
    shift = everyone[0].sysid - scenario.vehicles[0].sysid
    network = network_of(scenario, [stand.sysid for stand in everyone], options.delay_s, shift)
    return [
        VehicleConfig(
            sysid=stand.sysid,
            name=stand.name,
            frame=scenario.frame,
            home_m=stand.home_m,
            airframe=scenario.airframe.airframe(),
            terrain=scenario.environment.terrain,
            seed=options.seed,
            steady_wind_m_s=wind.steady_m_s,
            forecast_wind_m_s=wind.forecast_m_s,
            gusts=wind.gusts,
            gains=vehicle_gains(formation, stand.sysid - shift),
            network=network,
            arm=options.arm,
            swarm_clock=formation.swarm_clock and options.arm == "full",
            real_time=options.real_time,
            avoid_m=scenario.limits.separation_m if formation.avoidance else None,
            reassign=options.reassign if options.arm == "full" else None,
        )
        for stand in everyone
    ]
