"""`skein download`: what vehicles hold, as files."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from gcs.cli.counted import counted
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

FolderOption = Annotated[Path, typer.Option("--out", metavar="DIR", help="Folder for <sysid>.plan.")]
CRUISE_SPEED_M_S = 25.0
"""What QGroundControl reckons flight times with; the vehicle does not tell."""


def download(
    out: FolderOption = Path(),
    connect: ConnectOption = None,
    vehicle: VehicleOption = None,
    wait: WaitOption = None,
    signing_key: KeyOption = None,
    json: JsonOption = False,
) -> None:
    """Download missions, fences and rally points.

    Of all vehicles at once, each vehicle's as a .plan file.

    Example: skein download --out held --vehicle 2
    """
    with exit_codes():
        from gcs.operations import download_plan
        from missions.formats.qgc_plan import write_plan

        out.mkdir(parents=True, exist_ok=True)

        async def save(one: "VehicleLink") -> dict[str, Any]:
            plan = await download_plan(one)
            path = out / f"{one.sysid}.plan"
            write_plan(plan, path, cruise_speed_m_s=CRUISE_SPEED_M_S, autopilot=one.autopilot)
            counts = {"mission": len(plan.mission), "fence": len(plan.fence.areas), "rally": len(plan.rally)}
            return {"file": str(path), **counts}

        options = StationOptions(connect, vehicle, wait, signing_key, json)
        for_vehicles(options, "Downloaded", save, words=_words)


def _words(saved: dict[str, Any]) -> str:
    counts = {"mission": "item", "fence": "area", "rally": "point"}
    held = ", ".join(f"{name} {counted(saved[name], what)}" for name, what in counts.items())
    return f"{saved['file']}: {held}"
