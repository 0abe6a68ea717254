"""`skein sim`: a swarm of simulated vehicles for any ground station."""

from typing import TYPE_CHECKING, Annotated

import typer

from gcs.cli.errors import FELL_SHORT, exit_codes
from gcs.cli.options import ScenarioArgument, SeedOption, SpeedOption

if TYPE_CHECKING:
    from sitl.swarm import Swarm

STATION_HOST = "127.0.0.1"
STATION_PORT = 14550
"""Where ground stations listen for UDP."""
WATCH_PERIOD_S = 0.5

CountOption = Annotated[int | None, typer.Option("--count", metavar="N", min=1, help="Only the first N vehicles.")]
HeldOption = Annotated[bool, typer.Option("--held", help="Hold the clock at simulated time 0 until Enter is pressed.")]
TcpPortOption = Annotated[
    int, typer.Option("--tcp-port", metavar="P", min=0, max=65000, help="First vehicle's, 10 more each; 0: free ones.")
]


def sim(
    scenario: ScenarioArgument = "radars",
    count: CountOption = None,
    speed: SpeedOption = 1.0,
    held: HeldOption = False,
    seed: SeedOption = None,
    tcp_port: TcpPortOption = 5760,
) -> None:
    """Leave a swarm running for any station: telemetry to UDP 14550, TCP at 5760, 5770, ... Ends with Ctrl-C.

    Example: skein sim vee --count 3
    """
    with exit_codes():
        from gcs.cli import output
        from gcs.cli.tables import endpoint_table
        from missions.errors import InputError
        from missions.scenario import load_scenario
        from sitl.swarm import Swarm, SwarmOptions

        loaded = load_scenario(scenario)
        if count is not None and count > len(loaded.vehicles):
            raise InputError(f"--count {count}: {loaded.name} has {len(loaded.vehicles)} vehicles")
        flown = loaded.model_copy(update={"vehicles": loaded.vehicles[:count]})
        options = SwarmOptions(
            seed=loaded.seed if seed is None else seed,
            delay_s=loaded.formation.delay_s,
            held=held,
            speed=speed or float("inf"),
            stations=((STATION_HOST, STATION_PORT),),
            tcp_port=tcp_port,
        )
        with Swarm(flown, options) as swarm:
            output.out.print(endpoint_table(flown, swarm, STATION_PORT))
            if held:
                _release_on_enter(swarm)
            output.out.print("Ctrl-C ends the simulation.")
            _watch(swarm)
        raise SystemExit(FELL_SHORT)


def _release_on_enter(swarm: "Swarm") -> None:
    """Wait for Enter, then let the clocks go; without a keyboard they stay held."""
    from gcs.cli import output
    from gcs.swarm_clock import SwarmClock
    from sitl.zenoh_session import open_session

    output.out.print("The clock is held; Enter releases it.")
    try:
        input()
    except EOFError:
        return
    with open_session(swarm.station_peer) as session:
        SwarmClock(session, swarm.name, swarm.endpoints).release(swarm.endpoints)


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
