"""`skein upload`: bring missions to vehicles, and read them back."""

import re
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from gcs.cli.counted import counted
from gcs.cli.errors import exit_codes
from gcs.cli.import_files import ComplexChoice, ComplexOption, HomeOption, read_files
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

if TYPE_CHECKING:
    from gcs.vehicle_link import VehicleLink
    from missions.formats.mission_file import MissionFile
    from missions.vehicle_plan import Plan

SourceArgument = Annotated[
    Path,
    typer.Argument(
        metavar="RUN|FOLDER|FILE",
        help="A run: each vehicle's mission; a folder of exported .plan files: each to the vehicle that its name "
        "begins with; or a .plan or .waypoints file for chosen vehicles.",
    ),
]
_EXPORTED = re.compile(r"(\d+)-.*\.plan")


def upload(
    source: SourceArgument,
    home: HomeOption = None,
    complex_items: ComplexOption = ComplexChoice.refuse,
    connect: ConnectOption = None,
    vehicle: VehicleOption = None,
    wait: WaitOption = None,
    signing_key: KeyOption = None,
    json: JsonOption = False,
) -> None:
    """Upload missions, read each back and compare.

    To all vehicles at once; a .plan file's fence and rally points too.

    Example: skein upload runs/first --vehicle 1-3

    Example: skein upload runs/first/missions/relative
    """
    with exit_codes():
        from gcs.operations import upload_plan

        options = StationOptions(connect, vehicle, wait, signing_key, json)
        title = "Uploaded, read back and compared"
        if source.is_dir():
            written: dict[int, MissionFile] = {}
            plans = _chosen(_plans_in(source, home, complex_items, written), source, options.sysids())

            def warn(vehicles: "Sequence[VehicleLink]") -> None:
                for one in vehicles:
                    _warn_of_dialect(one, written.get(one.sysid))

            for_vehicles(
                options,
                title,
                lambda one: upload_plan(one, plans[one.sysid]),
                sysids=list(plans),
                check=warn,
                words=_words,
            )
        else:
            file = _read_file(source, home, complex_items)

            def check(vehicles: "Sequence[VehicleLink]") -> None:
                if options.vehicle is None:
                    require_one(vehicles, "one file")
                for one in vehicles:
                    _warn_of_dialect(one, file)

            for_vehicles(options, title, lambda one: upload_plan(one, file.plan), check=check, words=_words)


def _warn_of_dialect(vehicle: "VehicleLink", file: "MissionFile | None") -> None:
    """Say it when a file is in another autopilot's dialect: speeds and altitudes may mean something else there."""
    from gcs.cli import output

    if file is not None and file.autopilot not in (None, vehicle.autopilot):
        output.progress.print(
            f"{vehicle}: {file.path} says that it is for {file.autopilot}, and the vehicle is {vehicle.autopilot}: "
            f"speeds may mean something else to it; `skein export --autopilot {vehicle.autopilot}` writes its own",
            soft_wrap=True,
            markup=False,
        )


def _plans_in(
    folder: Path, home: str | None, complex_items: ComplexChoice, written: "dict[int, MissionFile]"
) -> "dict[int, Plan]":
    """By system id: what files named <sysid>-<name>.plan hold, as `skein export` writes them, or else a run's missions.
    The files go into `written`.

    Raises:
        InputError: it is neither, a file cannot be read, or two are for one vehicle.
    """
    from gcs.run_folder import RunFolder
    from missions.errors import InputError
    from missions.vehicle_plan import Plan

    plans: dict[int, Plan] = {}
    for path in sorted(folder.glob("*.plan")):
        if (found := _EXPORTED.fullmatch(path.name)) is not None:
            if (sysid := int(found[1])) in plans:
                raise InputError(f"{path}: another file here is for vehicle {sysid}, too; leave one of them")
            written[sysid] = _read_file(path, home, complex_items)
            plans[sysid] = written[sysid].plan
    if not plans:
        if home is not None or complex_items is not ComplexChoice.refuse:
            raise InputError(f"{folder}: is a run; --home and --complex are for files of other stations")
        _, formation = RunFolder(folder).read()
        plans = {uav.sysid: Plan(uav.mission) for uav in formation.uavs}
    return dict(sorted(plans.items()))


def _chosen(plans: "dict[int, Plan]", folder: Path, sysids: Sequence[int] | None) -> "dict[int, Plan]":
    """Of these vehicles only, if they are given. Raises InputError when one has no plan."""
    from missions.errors import InputError

    if unknown := [sysid for sysid in sysids or () if sysid not in plans]:
        raise InputError(f"{folder}: has no mission for vehicle {unknown[0]}; there are {', '.join(map(str, plans))}")
    return plans if sysids is None else {sysid: plans[sysid] for sysid in sysids}


def _read_file(path: Path, home: str | None, complex_items: ComplexChoice) -> "MissionFile":
    from gcs.cli import output
    from missions.errors import InputError

    if not path.suffix and not path.exists():
        raise InputError(f"{path}: neither a run's folder nor a .plan or .waypoints file")
    (found,) = read_files([path], home, complex_items)
    for note in found.notes:
        output.progress.print(f"{path}: {note}", soft_wrap=True, markup=False)
    return found


def _words(counts: dict[str, int]) -> str:
    return ", ".join(f"{name} {counted(count, 'item')}" for name, count in counts.items())
