"""`skein params`: read, change, save and load the parameters of vehicles."""

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
)

if TYPE_CHECKING:
    from gcs.vehicle_link import VehicleLink

params = typer.Typer(name="params", help="Read, change, save and load parameters.", no_args_is_help=True)

NameArgument = Annotated[str, typer.Argument(metavar="NAME", help="Such as WP_LOITER_RAD.")]
ValueArgument = Annotated[float, typer.Argument(metavar="VALUE")]
FileArgument = Annotated[Path, typer.Argument(metavar="FILE", help="A .param file: NAME,VALUE a line.")]
FolderArgument = Annotated[Path, typer.Argument(metavar="DIR", help="Folder for <sysid>.param.")]


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
        for_vehicles(StationOptions(connect, vehicle, wait, signing_key, json), "Parameters", _values, words=_lines)


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

        options = StationOptions(connect, vehicle, wait, signing_key, json)
        for_vehicles(options, name.upper(), change, words="{:g}".format)


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
            values = await _values(one)
            path = folder / f"{one.sysid}.param"
            write_param(values, path)
            return {"file": str(path), "parameters": len(values)}

        words = "{file}: {parameters} parameters".format_map
        for_vehicles(StationOptions(connect, vehicle, wait, signing_key, json), "Saved", keep, words=words)


@params.command("load")
def load(
    file: FileArgument,
    connect: ConnectOption = None,
    vehicle: VehicleOption = None,
    wait: WaitOption = None,
    signing_key: KeyOption = None,
    json: JsonOption = False,
) -> None:
    """Set all parameters of a file that differ from the vehicles', and see that they hold them.

    Example: skein params load backup/1.param --vehicle 1
    """
    with exit_codes():
        from gcs.transfers.parameters import set_parameter
        from missions.formats.param import read_param

        wanted = read_param(file)

        async def change(one: "VehicleLink") -> dict[str, float]:
            held = await _values(one)
            changed = {name: value for name, value in wanted.items() if held.get(name) != value}
            for name, value in changed.items():
                await set_parameter(one, name, value)
            return changed

        words = _changed
        for_vehicles(StationOptions(connect, vehicle, wait, signing_key, json), "Loaded", change, words=words)


async def _values(one: "VehicleLink") -> dict[str, float]:
    from gcs.transfers.parameters import fetch_parameters

    return {name: value for name, (value, _) in (await fetch_parameters(one)).items()}


def _lines(values: dict[str, float]) -> str:
    return "\n".join(f"{name:<16} {value:g}" for name, value in values.items())


def _changed(values: dict[str, float]) -> str:
    return ", ".join(f"{name} {value:g}" for name, value in values.items()) or "held already"
