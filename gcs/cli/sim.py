"""`skein sim`: a swarm of simulated vehicles for any ground station."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from gcs.cli.errors import FELL_SHORT, exit_codes
from gcs.cli.options import (
    JsonOption,
    NoCorrectionsOption,
    NoNeighboursOption,
    RealTimeOption,
    ScenarioArgument,
    SeedOption,
    SpeedOption,
    chosen_arm,
    clock_speed,
)

if TYPE_CHECKING:
    from collections.abc import Sequence

    from rich.console import Console

    from sitl.swarm import Swarm

WATCH_PERIOD_S = 0.5
TOGETHER_S = 30.0
"""Within which the vehicles of all machines are to be there."""

CountOption = Annotated[
    int | None,
    typer.Option(
        "--count",
        metavar="N",
        min=1,
        help="Only the first N vehicles; or, where the scenario has fewer, N with the others on a grid around its own, "
        "on the ground, flying in its graph but in no plan of its. (For a planned formation of N, set shape.count in "
        "the scenario.) System ids go on; at most 250.",
    ),
]
HeldOption = Annotated[bool, typer.Option("--held", help="Hold the clock at simulated time 0 until Enter is pressed.")]
InstanceOption = Annotated[
    int,
    typer.Option(
        "--instance",
        metavar="K",
        min=0,
        max=9,
        help="Another swarm on this machine: TCP ports from 5760 + 2500 K, telemetry to UDP 14550 + 10 K, a state "
        "folder of its own. For one station on all of them, give each --udp 127.0.0.1:14550 and its own --sysid-base.",
    ),
]
SysidBaseOption = Annotated[
    int | None,
    typer.Option("--sysid-base", metavar="S", min=1, max=250, help="System id of the first vehicle; all shift alike."),
]
UdpOption = Annotated[
    list[str] | None,
    typer.Option("--udp", metavar="HOST:PORT", help="Send telemetry there instead; may be given several times."),
]
TcpPortOption = Annotated[
    int | None,
    typer.Option("--tcp-port", metavar="P", min=0, max=65535, help="First vehicle's, 10 more each; 0: free ones."),
]
StateOption = Annotated[
    Path | None,
    typer.Option(
        "--state",
        metavar="DIR",
        help="Where the vehicles keep missions, fences, rally points and parameters over restarts; a folder for each "
        "scenario and instance in the user's state directory unless given.",
    ),
]
WipeOption = Annotated[bool, typer.Option("--wipe", "-w", help="Forget all that the vehicles kept, and begin afresh.")]
PerProcessOption = Annotated[
    int | None,
    typer.Option(
        "--per-process",
        metavar="M",
        min=1,
        help="Vehicles that share a process. Up to 24 have one each unless told otherwise, larger swarms as many "
        "processes as there are cores. The flight is the same.",
    ),
]
SigningKeyOption = Annotated[
    Path | None,
    typer.Option("--signing-key", metavar="FILE", help="Key that the vehicles sign with, and their stations must."),
]

ZenohOption = Annotated[
    Path | None,
    typer.Option(
        "--zenoh",
        metavar="FILE",
        help="Meet vehicles on other machines at a router (`skein router FILE`), as the file says: docs/real-time.md.",
    ),
]
VehicleOption = Annotated[
    str | None,
    typer.Option("--vehicle", metavar="IDS", help="Run only these on this machine, such as 1,4-6, with --zenoh."),
]


def sim(
    scenario: ScenarioArgument = "radars",
    count: CountOption = None,
    instance: InstanceOption = 0,
    speed: SpeedOption = 1.0,
    real_time: RealTimeOption = False,
    held: HeldOption = False,
    no_corrections: NoCorrectionsOption = False,
    no_neighbours: NoNeighboursOption = False,
    seed: SeedOption = None,
    sysid_base: SysidBaseOption = None,
    udp: UdpOption = None,
    tcp_port: TcpPortOption = None,
    state: StateOption = None,
    wipe: WipeOption = False,
    per_process: PerProcessOption = None,
    signing_key: SigningKeyOption = None,
    zenoh: ZenohOption = None,
    vehicle: VehicleOption = None,
    json: JsonOption = False,
) -> None:
    """Leave a swarm running for any ground station.

    Telemetry goes to UDP 14550, TCP is at 5760, 5770, ... Ends with Ctrl-C.

    Example: skein sim vee --count 3
    """
    with exit_codes():
        from contextlib import ExitStack

        from gcs.cli import output
        from gcs.cli.progress import working
        from gcs.cli.station import chosen_sysids
        from gcs.cli.tables import endpoint_table, ways_to_connect
        from gcs.signing_key import read_signing_key
        from gcs.sim_ports import parse_station, require_free_tcp, tcp_base, udp_port
        from gcs.state_folder import StateFolder, default_state_folder
        from gcs.zenoh_file import read_zenoh_file
        from missions.errors import InputError
        from missions.scenario import load_scenario
        from sitl.services.links import LOOPBACK
        from sitl.swarm import Swarm, SwarmOptions

        loaded = load_scenario(scenario)
        if vehicle is not None and zenoh is None:
            raise InputError("--vehicle: the others must be somewhere; say where they meet with --zenoh")
        here = chosen_sysids(vehicle)
        stations = [parse_station(text) for text in udp] if udp else [(LOOPBACK, udp_port(instance))]
        first_port = tcp_base(instance) if tcp_port is None else tcp_port
        with StateFolder(state or default_state_folder(loaded.name, instance)) as memory:
            if wipe:
                memory.wipe()
            options = SwarmOptions(
                seed=loaded.seed if seed is None else seed,
                delay_s=loaded.formation.delay_s,
                arm=chosen_arm(no_corrections, no_neighbours),
                held=held,
                speed=clock_speed(speed, real_time),
                real_time=real_time,
                stations=tuple(stations),
                tcp_port=first_port,
                memory=memory.path,
                signing_key=read_signing_key(signing_key, output.progress.print) if signing_key else None,
                count=count,
                sysid_base=sysid_base,
                per_process=per_process,
                zenoh=read_zenoh_file(zenoh) if zenoh else None,
                here=frozenset(here) if here else None,
            )
            if loaded.formation.reassign:
                output.progress.print("formation.reassign: a simulation knows no plan; all keep their own places")
            if first_port:
                require_free_tcp(first_port, count or len(loaded.vehicles))
            with ExitStack() as stack:
                with working(f"Launching {loaded.name}", brief=True):
                    swarm = stack.enter_context(Swarm(loaded, options))
                told = output.progress if json else output.out
                if json:
                    output.print_json_line(_as_json(loaded.name, swarm, stations, memory.path))
                else:
                    told.print(endpoint_table(loaded.name, swarm))
                    for line in ways_to_connect(swarm, stations, memory.path):
                        told.print(line, soft_wrap=True)
                # Of several machines, one starts the clocks: where Enter is pressed, or the first vehicle runs.
                if _enter_pressed(told) if held else real_time and swarm.sysids[0] in swarm.endpoints:
                    _release(swarm)
                told.print("Ctrl-C ends the simulation.")
                _watch(swarm)
        raise SystemExit(FELL_SHORT)


def _as_json(name: str, swarm: "Swarm", stations: "Sequence[tuple[str, int]]", state: Path) -> dict[str, Any]:
    """Where everybody can be reached."""
    from sitl.services.links import LOOPBACK

    return {
        "scenario": name,
        "vehicles": [
            {
                "sysid": endpoint.sysid,
                "name": endpoint.name,
                "tcp": f"{LOOPBACK}:{endpoint.ready.tcp_port}",
                "udp": f"{LOOPBACK}:{endpoint.ready.udp_port}",
                "pid": endpoint.process.pid,
            }
            for endpoint in swarm.endpoints.values()
            if endpoint.ready is not None
        ],
        "telemetry_to": [f"{host}:{port}" for host, port in stations],
        "state": str(state),
    }


def _enter_pressed(told: "Console") -> bool:
    """Wait for Enter; without a keyboard it is never pressed."""
    told.print("The clock is held; Enter releases it.")
    try:
        input()
    except EOFError:
        return False
    return True


def _release(swarm: "Swarm") -> None:
    """Let the clocks go, all at one moment."""
    from gcs.swarm_clock import SwarmClock
    from sitl.zenoh_session import open_session

    with open_session(swarm.station_peer) as session:
        SwarmClock(session, swarm.name, swarm.sysids, TOGETHER_S).start(swarm.sysids)


def _watch(swarm: "Swarm") -> None:
    """Say who was lost, until all are."""
    import time

    from gcs.cli import output

    lost: set[int] = set()
    while len(lost) < len(swarm.endpoints):
        for sysid, endpoint in swarm.endpoints.items():
            if sysid not in lost and (reason := endpoint.obituary()):
                lost.add(sysid)
                output.progress.print(f"vehicle {sysid} lost: {reason}")
        time.sleep(WATCH_PERIOD_S)
