"""`skein companion`: beside one autopilot, keep its vehicle with the swarm."""

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from gcs.cli.errors import exit_codes
from gcs.cli.options import JsonOption, RunArgument
from gcs.cli.station import DEFAULT_URL, KeyOption

if TYPE_CHECKING:
    from rich.console import Console

    from gcs.companion.companion import Companion
    from gcs.companion.run import Companionship
    from sitl.services.signing import Signing
    from sitl.zenoh_network import ZenohNetwork

VehicleUrlOption = Annotated[
    str, typer.Option("--vehicle", metavar="URL", help="Where its autopilot is, as --connect of other commands.")
]
SlotOption = Annotated[
    int, typer.Option("--slot", metavar="N", min=1, help="System id of the vehicle in the run's plan.")
]
ZenohFileOption = Annotated[
    Path, typer.Option("--zenoh", metavar="FILE", help="How the companions meet at a router; see docs/real-time.md.")
]
WAIT_S = 600.0
"""For an autopilot that is still starting."""


def companion(
    run: RunArgument,
    slot: SlotOption,
    zenoh: ZenohFileOption,
    vehicle: VehicleUrlOption = DEFAULT_URL,
    signing_key: KeyOption = None,
    json: JsonOption = False,
) -> None:
    """Keep one vehicle with its neighbours, from beside it.

    MAVLink to its autopilot, which knows no formation, corrections over Zenoh.

    It commands airspeeds while the vehicle flies its mission in AUTO, about one a second, and ends when that is over.
    Uploading and starting the mission is a station's business.

    Example: skein companion runs/first --vehicle serial:///dev/ttyAMA0:921600 --slot 3 --zenoh field.toml
    """
    with exit_codes():
        import asyncio

        from gcs.cli import output
        from gcs.cli.station import signing_of
        from gcs.companion.run import Companionship
        from gcs.run_folder import RunFolder
        from gcs.zenoh_file import read_zenoh_file
        from missions.errors import InputError

        shared = Companionship(*RunFolder(run).read())
        if slot not in shared.slots:
            raise InputError(f"--slot {slot}: the plan has {', '.join(map(str, shared.slots))}")
        network = read_zenoh_file(zenoh)
        told = output.progress if json else output.out
        arrival_s = asyncio.run(_accompany(shared, slot, network, vehicle, signing_of(signing_key), told))
        if json:
            output.print_json({"slot": slot, "planned_s": shared.planned_s[slot], "arrival_s": arrival_s})
        elif arrival_s is not None:
            output.out.print(f"Slot {slot}: arrived, {arrival_s - shared.planned_s[slot]:+.2f} s against the plan")


async def _accompany(
    shared: "Companionship", slot: int, network: "ZenohNetwork", url: str, signing: "Signing", told: "Console"
) -> float | None:
    """When its path was over, since the launch; who is accompanied is printed to `told`."""
    from gcs.cli import output
    from gcs.companion.neighbourhood import Neighbourhood
    from gcs.companion.run import accompany
    from gcs.fleet import Fleet
    from gcs.links.open_link import open_link
    from gcs.station_logs import station_logs
    from sitl.zenoh_network import vehicle_name
    from sitl.zenoh_session import open_session

    async with Fleet(station_logs(), signing=signing, announce=output.progress.print) as fleet:
        fleet.attach(await open_link(url))
        vehicle = await fleet.hear_one(WAIT_S)
        with open_session(network.client(vehicle_name(slot)), real_time=True) as session:
            near = Neighbourhood(session, network.swarm, slot, shared.weights(slot))
            others = ", ".join(map(str, shared.weights(slot)))
            told.print(f"Slot {slot}: {vehicle} at {vehicle.peer}, neighbours {others}")

            def make(command: Callable[[float], None]) -> "Companion":
                return shared.companion(slot, near.say, near.heard, command)

            ended = await accompany(vehicle, make, output.progress.print)
            for line in near.complaints():
                output.progress.print(line)
            return ended.arrival_s
