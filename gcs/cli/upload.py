"""`skein upload`: bring missions to vehicles, and read them back."""

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
    from missions.vehicle_plan import Plan

SourceArgument = Annotated[
    Path,
    typer.Argument(
        metavar="RUN|FILE", help="A run: each vehicle's mission; or a .plan or .waypoints file for chosen vehicles."
    ),
]


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
    """Upload missions to all vehicles at once, read each back and compare; a .plan file's fence and rally points too.

    Example: skein upload runs/first --vehicle 1-3
    """
    with exit_codes():
        from gcs.operations import upload_plan
        from missions.errors import InputError

        options = StationOptions(connect, vehicle, wait, signing_key, json)
        title = "Uploaded, read back and compared"
        if source.is_dir():
            if home is not None or complex_items is not ComplexChoice.refuse:
                raise InputError(f"{source}: is a run; --home and --complex are for files of other stations")
            plans = _plans_of_run(source, options.sysids())
            for_vehicles(
                options, title, lambda one: upload_plan(one, plans[one.sysid]), sysids=list(plans), words=_words
            )
        else:
            plan = _plan_of_file(source, home, complex_items)

            def check(vehicles: "Sequence[VehicleLink]") -> None:
                if options.vehicle is None:
                    require_one(vehicles, "one file")

            for_vehicles(options, title, lambda one: upload_plan(one, plan), check=check, words=_words)


def _plans_of_run(folder: Path, sysids: Sequence[int] | None) -> "dict[int, Plan]":
    """The missions of a run by system id, of these vehicles only if they are given."""
    from gcs.run_folder import RunFolder
    from missions.errors import InputError
    from missions.vehicle_plan import Plan

    _, formation = RunFolder(folder).read()
    plans = {uav.sysid: Plan(uav.mission) for uav in formation.uavs}
    if unknown := [sysid for sysid in sysids or () if sysid not in plans]:
        raise InputError(f"{folder}: has no mission for vehicle {unknown[0]}; there are {', '.join(map(str, plans))}")
    return plans if sysids is None else {sysid: plans[sysid] for sysid in sysids}


def _plan_of_file(path: Path, home: str | None, complex_items: ComplexChoice) -> "Plan":
    from gcs.cli import output
    from missions.errors import InputError

    if not path.suffix and not path.exists():
        raise InputError(f"{path}: neither a run's folder nor a .plan or .waypoints file")
    (found,) = read_files([path], home, complex_items)
    for note in found.notes:
        output.progress.print(f"{path}: {note}", soft_wrap=True, markup=False)
    return found.plan


def _words(counts: dict[str, int]) -> str:
    return ", ".join(f"{name} {counted(count, 'item')}" for name, count in counts.items())
