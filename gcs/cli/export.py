"""`skein export`: a run's missions as files for autopilots, other ground stations, maps and globes."""

from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer

from gcs.cli.errors import exit_codes
from gcs.cli.options import JsonOption, RunArgument
from missions.altitude_frame import AltitudeFrame
from missions.autopilot import Autopilot


class MissionFormat(StrEnum):
    """File formats of missions."""

    plan = "plan"
    waypoints = "waypoints"
    kml = "kml"
    czml = "czml"
    geojson = "geojson"


FormatOption = Annotated[
    MissionFormat,
    typer.Option(
        "--format",
        help="plan: QGroundControl, MAVSDK; waypoints: Mission Planner, MAVProxy; kml: Google Earth; czml: Cesium; "
        "geojson: maps.",
    ),
]
AutopilotOption = Annotated[Autopilot, typer.Option("--autopilot", help="Whose dialect plan and waypoints are in.")]
FrameOption = Annotated[
    AltitudeFrame,
    typer.Option(
        "--frame", help="What altitudes are above: the sea, home, or the ground as the autopilot knows it (ArduPilot)."
    ),
]
LandingOption = Annotated[
    bool, typer.Option("--landing", help="Land near the targets at the end, instead of circling there.")
]
FolderOption = Annotated[
    Path | None,
    typer.Option("--out", metavar="DIR", help="Folder; unless given the run's missions/, or one in it for a choice."),
]


def export(
    run: RunArgument,
    file_format: FormatOption,
    autopilot: AutopilotOption = Autopilot.ardupilot,
    frame: FrameOption = AltitudeFrame.amsl,
    landing: LandingOption = False,
    out: FolderOption = None,
    json: JsonOption = False,
) -> None:
    """Write missions as files for autopilots, stations and maps.

    Each vehicle's is a file; for maps, all vehicles together as well.

    Example: skein export runs/first --format plan --autopilot px4 --frame relative
    """
    with exit_codes():
        from gcs.cli import output
        from gcs.cli.progress import working

        with working("Loading", brief=True):
            from gcs.export import ExportOptions
            from gcs.export import export as write
            from gcs.run_folder import RunFolder

        scenario, plan = RunFolder(run).read()
        choice = [autopilot.value] * (autopilot is not Autopilot.ardupilot)
        choice += [frame.value] * (frame is not AltitudeFrame.amsl) + ["landing"] * landing
        folder = out or run / "missions" / "-".join(choice)
        folder.mkdir(parents=True, exist_ok=True)
        with working("Writing files", brief=True):
            exported = write(scenario, plan, ExportOptions(file_format.value, autopilot, frame, landing), folder)
        if json:
            output.print_json({"files": [str(path) for path in exported.files], "notes": list(exported.notes)})
            return
        for path in exported.files:
            output.out.print(str(path), markup=False, soft_wrap=True)
        for note in exported.notes:
            output.progress.print(f"skein: {note}", markup=False, soft_wrap=True)
