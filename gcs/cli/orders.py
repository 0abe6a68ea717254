"""`skein arm | disarm | mode | rtl | abort`: orders to all vehicles at once, each confirmed by the vehicle."""

from typing import TYPE_CHECKING, Annotated

import typer

from gcs.cli.completion import modes
from gcs.cli.errors import exit_codes
from gcs.cli.options import JsonOption
from gcs.cli.station import (
    ConnectOption,
    KeyOption,
    StationOptions,
    VehicleOption,
    WaitOption,
    for_vehicles,
)

if TYPE_CHECKING:
    from sitl.modes import Mode

ForceOption = Annotated[bool, typer.Option("--force", help="Whatever the vehicle's checks say.")]
ModeArgument = Annotated[
    str, typer.Argument(metavar="MODE", autocompletion=modes, help="AUTO, LOITER, RTL, GUIDED, TAKEOFF or MANUAL.")
]


def arm(
    force: ForceOption = False,
    connect: ConnectOption = None,
    vehicle: VehicleOption = None,
    wait: WaitOption = None,
    signing_key: KeyOption = None,
    json: JsonOption = False,
) -> None:
    """Arm; a refusal comes with the vehicle's reason.

    Example: skein arm --vehicle 1-3
    """
    with exit_codes():
        from gcs.transfers.command import arm as arm_vehicle

        options = StationOptions(connect, vehicle, wait, signing_key, json)
        for_vehicles(options, "Arm", lambda one: arm_vehicle(one, force=force), words=lambda _: "armed")


def disarm(
    force: ForceOption = False,
    connect: ConnectOption = None,
    vehicle: VehicleOption = None,
    wait: WaitOption = None,
    signing_key: KeyOption = None,
    json: JsonOption = False,
) -> None:
    """Disarm; in flight only with --force. Waits for no vehicle that is missing.

    Example: skein disarm --vehicle 2
    """
    with exit_codes():
        from gcs.transfers.command import disarm as disarm_vehicle

        options = StationOptions(connect, vehicle, wait, signing_key, json)
        for_vehicles(
            options, "Disarm", lambda one: disarm_vehicle(one, force=force), words=lambda _: "disarmed", whoever=True
        )


def mode(
    mode: ModeArgument,
    connect: ConnectOption = None,
    vehicle: VehicleOption = None,
    wait: WaitOption = None,
    signing_key: KeyOption = None,
    json: JsonOption = False,
) -> None:
    """Change the flight mode, and see it in the vehicle's heartbeats.

    Example: skein mode AUTO
    """
    with exit_codes():
        _change_mode(_mode(mode), StationOptions(connect, vehicle, wait, signing_key, json))


def rtl(
    connect: ConnectOption = None,
    vehicle: VehicleOption = None,
    wait: WaitOption = None,
    signing_key: KeyOption = None,
    json: JsonOption = False,
) -> None:
    """Return to launch: mode RTL, seen in the vehicle's heartbeats. Waits for no vehicle that is missing.

    Example: skein rtl --vehicle 2
    """
    with exit_codes():
        _change_mode(_mode("RTL"), StationOptions(connect, vehicle, wait, signing_key, json), whoever=True)


def abort(
    connect: ConnectOption = None,
    vehicle: VehicleOption = None,
    wait: WaitOption = None,
    signing_key: KeyOption = None,
    json: JsonOption = False,
) -> None:
    """Bring every vehicle home and confirm each.

    RTL in the air, disarmed on the ground.

    Each is told as soon as it is heard; one that is missing holds up none of the others.

    Example: skein abort
    """
    with exit_codes():
        from gcs.operations import bring_home

        for_vehicles(StationOptions(connect, vehicle, wait, signing_key, json), "Abort", bring_home, whoever=True)


def _change_mode(mode: "Mode", options: StationOptions, whoever: bool = False) -> None:
    from gcs.operations import change_mode

    for_vehicles(options, "Mode", lambda one: change_mode(one, mode), words=lambda _: mode.name, whoever=whoever)


def _mode(name: str) -> "Mode":
    from missions.errors import InputError
    from sitl.modes import Mode

    try:
        return Mode[name.upper()]
    except KeyError:
        raise InputError(f"mode {name}: there are {', '.join(Mode.__members__)}") from None
