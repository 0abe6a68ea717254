"""`skein params`: read, change, save and load the parameters of vehicles."""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from gcs.cli.errors import exit_codes
from gcs.cli.options import JsonOption
from gcs.cli.station import (
    ConnectOption,
    KeyOption,
    StationOptions,
    VehicleOption,
    WaitOption,
    for_vehicles,
    require_one,
)
from gcs.cli.verbosity import Commands

if TYPE_CHECKING:
    from gcs.vehicle_link import VehicleLink

params = Commands(name="params", help="Read, change, save and load parameters.", no_args_is_help=True)

NameArgument = Annotated[str, typer.Argument(metavar="NAME", help="Such as WP_LOITER_RAD.")]
ValueArgument = Annotated[float, typer.Argument(metavar="VALUE")]
SourceArgument = Annotated[
    Path,
    typer.Argument(
        metavar="FILE|DIR", help="A .param file for all, NAME,VALUE a line; or a folder with a <sysid>.param of each."
    ),
]
FolderArgument = Annotated[Path, typer.Argument(metavar="DIR", help="Folder for <sysid>.param.")]
SYSTEM_IDS = ("MAV_SYSID", "SYSID_THISMAV")
"""Each vehicle's own: no two may have the same."""
NOT_LOADED = (*SYSTEM_IDS, "MIS_TOTAL", "FENCE_TOTAL", "RALLY_TOTAL")
"""The totals are counted by the vehicle, and read-only."""


@params.command("list")
def list_all(
    connect: ConnectOption = None,
    vehicle: VehicleOption = None,
    wait: WaitOption = None,
    signing_key: KeyOption = None,
    json: JsonOption = False,
) -> None:
    """All parameters of all vehicles.

    Example: skein params list --vehicle 1
    """
    with exit_codes():
        for_vehicles(StationOptions(connect, vehicle, wait, signing_key, json), "Parameters", values_of, words=_lines)


@params.command("get")
def get(
    name: NameArgument,
    connect: ConnectOption = None,
    vehicle: VehicleOption = None,
    wait: WaitOption = None,
    signing_key: KeyOption = None,
    json: JsonOption = False,
) -> None:
    """One parameter of all vehicles.

    Example: skein params get RTL_ALTITUDE
    """
    with exit_codes():
        from gcs.transfers.parameters import read_parameter

        async def read(one: "VehicleLink") -> float:
            return (await read_parameter(one, name)).value

        for_vehicles(StationOptions(connect, vehicle, wait, signing_key, json), name.upper(), read, words="{:g}".format)


@params.command("set")
def set_one(
    name: NameArgument,
    value: ValueArgument,
    connect: ConnectOption = None,
    vehicle: VehicleOption = None,
    wait: WaitOption = None,
    signing_key: KeyOption = None,
    json: JsonOption = False,
) -> None:
    """Set one parameter on all vehicles, and see that they hold it.

    Example: skein params set RTL_ALTITUDE 150
    """
    with exit_codes():
        from gcs.transfers.parameters import set_parameter

        async def change(one: "VehicleLink") -> float:
            return (await set_parameter(one, name, value)).value

        def check(vehicles: "Sequence[VehicleLink]") -> None:
            if name.upper() in SYSTEM_IDS:
                require_one(vehicles, "one system id")

        options = StationOptions(connect, vehicle, wait, signing_key, json)
        for_vehicles(options, name.upper(), change, check=check, words="{:g}".format)


@params.command("save")
def save(
    folder: FolderArgument,
    connect: ConnectOption = None,
    vehicle: VehicleOption = None,
    wait: WaitOption = None,
    signing_key: KeyOption = None,
    json: JsonOption = False,
) -> None:
    """Save all parameters of all vehicles, each vehicle's as a .param file.

    Example: skein params save backup
    """
    with exit_codes():
        from missions.formats.param import write_param

        folder.mkdir(parents=True, exist_ok=True)

        async def keep(one: "VehicleLink") -> dict[str, Any]:
            values = await values_of(one)
            path = folder / f"{one.sysid}.param"
            write_param(values, path)
            return {"file": str(path), "parameters": len(values)}

        words = "{file}: {parameters} parameters".format_map
        for_vehicles(StationOptions(connect, vehicle, wait, signing_key, json), "Saved", keep, words=words)


@params.command("load")
def load(
    source: SourceArgument,
    connect: ConnectOption = None,
    vehicle: VehicleOption = None,
    wait: WaitOption = None,
    signing_key: KeyOption = None,
    json: JsonOption = False,
) -> None:
    """Set all parameters of a file that differ from the vehicles', and see that they hold them.

    System ids, and the numbers of items held, are left as they are: one vehicle's file may be loaded into others.

    Example: skein params load backup --vehicle 1-3
    """
    with exit_codes():
        from gcs.transfers.parameters import set_parameter
        from missions.formats.param import read_param
        from missions.mission import as_float32

        files: dict[int, dict[str, float]] = {}

        def read(vehicles: "Sequence[VehicleLink]") -> None:
            for one in vehicles:
                values = read_param(source / f"{one.sysid}.param" if source.is_dir() else source)
                files[one.sysid] = {name: value for name, value in values.items() if name not in NOT_LOADED}

        async def change(one: "VehicleLink") -> dict[str, float]:
            held = await values_of(one)
            wanted = files[one.sysid].items()
            changed = {name: value for name, value in wanted if held.get(name) != as_float32(value)}
            for name in sorted(
                changed, key=lambda name: name not in held
            ):  # which may not be there: let the rest be set
                await set_parameter(one, name, changed[name])
            return changed

        if not source.is_dir():
            read_param(source)  # before anybody is waited for
        options = StationOptions(connect, vehicle, wait, signing_key, json)
        for_vehicles(options, "Loaded", change, check=read, words=_changed)


async def values_of(one: "VehicleLink") -> dict[str, float]:
    """All parameters of a vehicle by name. Raises TransferError."""
    from gcs.transfers.parameters import fetch_parameters

    return {name: value for name, (value, _) in (await fetch_parameters(one)).items()}


def _lines(values: dict[str, float]) -> str:
    return "\n".join(f"{name:<16} {value:g}" for name, value in values.items())


def _changed(values: dict[str, float]) -> str:
    return ", ".join(f"{name} {value:g}" for name, value in values.items()) or "held already"
