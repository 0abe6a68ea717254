"""`skein export`: a run's missions as files for other ground stations."""

from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer

from gcs.cli.errors import exit_codes
from gcs.cli.options import RunArgument


class MissionFormat(StrEnum):
    """File formats of missions."""

    plan = "plan"
    waypoints = "waypoints"


FormatOption = Annotated[
    MissionFormat, typer.Option("--format", help="plan: QGroundControl; waypoints: Mission Planner, MAVProxy.")
]
FolderOption = Annotated[
    Path | None, typer.Option("--out", metavar="DIR", help="Folder; the run's missions/ unless given.")
]


def export(run: RunArgument, file_format: FormatOption, out: FolderOption = None) -> None:
    """Write each vehicle's mission as a file.

    Example: skein export runs/first --format waypoints --out /tmp/missions
    """
    with exit_codes():
        from gcs.cli import output
        from gcs.run_folder import RunFolder, export_missions

        scenario, plan = RunFolder(run).read()
        folder = out or run / "missions"
        folder.mkdir(parents=True, exist_ok=True)
        for path in export_missions(scenario, plan, file_format.value, folder):
            output.out.print(str(path), soft_wrap=True)
