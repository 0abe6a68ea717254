"""`skein check`: mission files judged before anybody flies them."""

import math
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from gcs.cli.errors import FELL_SHORT, exit_codes
from gcs.cli.import_files import ComplexChoice, ComplexOption, FilesArgument, HomeOption, TerrainOption, read_files
from gcs.cli.options import DarkOption, JsonOption, finite
from gcs.cli.station import (
    ConnectOption,
    KeyOption,
    StationOptions,
    VehicleOption,
    WaitOption,
    require_one,
    results_of,
)
from gcs.theme import drawn_dark

if TYPE_CHECKING:
    from gcs.check.check import Checked
    from gcs.check.held import VehicleLimits
    from gcs.vehicle_link import VehicleLink
    from missions.formats.mission_file import MissionFile
    from missions.scenario import Scenario

AgainstOption = Annotated[
    str | None,
    typer.Option("--scenario", metavar="S", help="Ground, obstacles, airframe, wind and limits of this scenario."),
]
AirframeOption = Annotated[
    str | None,
    typer.Option("--airframe", metavar="S", help="The airframe of this scenario; vee's unless one is given."),
]
EnduranceOption = Annotated[
    float | None, typer.Option("--endurance", metavar="MIN", min=0.0, callback=finite, help="Longest flight.")
]
RangeOption = Annotated[
    float | None, typer.Option("--range", metavar="KM", min=0.0, callback=finite, help="Farthest flight.")
]
FigureOption = Annotated[
    Path | None, typer.Option("--figure", metavar="PNG", help="Draw what the files hold: items, circles, fences.")
]


def check(
    files: FilesArgument,
    scenario: AgainstOption = None,
    airframe: AirframeOption = None,
    terrain: TerrainOption = None,
    endurance: EnduranceOption = None,
    range_km: RangeOption = None,
    home: HomeOption = None,
    complex_items: ComplexOption = ComplexChoice.refuse,
    connect: ConnectOption = None,
    vehicle: VehicleOption = None,
    wait: WaitOption = None,
    signing_key: KeyOption = None,
    figure: FigureOption = None,
    dark: DarkOption = False,
    json: JsonOption = False,
) -> None:
    """Check mission files, each alone and all flown at once.

    Ground, fence, turns, climbs, speeds, separation, range; and what a vehicle's parameters forbid.

    With --connect or --vehicle also what that vehicle forbids of them, by its parameters and its room for items.

    Example: skein check a.plan b.waypoints --terrain ground.tif --endurance 45
    """
    with exit_codes(), drawn_dark(dark):
        from gcs.cli.progress import working

        with working("Loading", brief=True):
            from gcs.check.check import check_files
            from gcs.check.setting import setting_for
            from gcs.cli import output
            from missions.errors import InputError
            from missions.scenario import load_scenario

        if scenario is not None and (airframe is not None or terrain is not None):
            raise InputError("--scenario brings its airframe and its ground; leave --airframe and --terrain out")
        with working("Reading files and ground", brief=True):
            found = read_files(files, home, complex_items)
            against = (
                setting_for([one.plan.mission for one in found], airframe, terrain)
                if scenario is None
                else load_scenario(scenario)
            )
        asked = StationOptions(connect, vehicle, wait, signing_key, json)
        limits = None if connect is None and vehicle is None else _limits_of(asked)
        ground_known = scenario is not None or terrain is not None
        with working("Checking", brief=True):
            checked = check_files(
                found,
                against,
                ground_known=ground_known,
                limits_given=scenario is not None,
                endurance_s=math.inf if endurance is None else 60.0 * endurance,
                range_m=math.inf if range_km is None else 1000.0 * range_km,
                vehicle=limits,
            )
            if figure is not None:
                _draw(found, against, figure)
        unchecked = _unchecked(ground_known, scenario is not None, endurance is not None or range_km is not None)
        if limits is not None and not limits.capacities:
            unchecked.append("how many items the vehicle takes: it does not say, or is not ready, or flies")
        if json:
            output.print_json(_as_json(found, checked, unchecked))
        else:
            _show(found, checked, unchecked)
        if checked.problems:
            raise SystemExit(FELL_SHORT)


def _draw(files: "Sequence[MissionFile]", scenario: "Scenario", figure: Path) -> None:
    from gcs.figures import draw_mission_files
    from missions.errors import InputError

    if figure.suffix.lower() != ".png":
        raise InputError(f"--figure {figure}: name a .png file")
    draw_mission_files({one.path.stem: one.plan for one in files}, scenario, figure)


def _limits_of(options: StationOptions) -> "VehicleLimits":
    """What one vehicle tells of itself. Raises InputError, TransferError."""
    import asyncio

    from gcs.check.held import VehicleLimits
    from gcs.cli.params import values_of
    from gcs.transfers.capacity import capacities

    def one_only(vehicles: "Sequence[VehicleLink]") -> None:
        require_one(vehicles, "one check")

    async def ask(one: "VehicleLink") -> VehicleLimits:
        return VehicleLimits(await values_of(one), await capacities(one), one.autopilot)

    (limits,) = asyncio.run(results_of(options, options.sysids(), ask, one_only)).values()
    if isinstance(limits, Exception):
        raise limits
    assert isinstance(limits, VehicleLimits)
    return limits


def _unchecked(ground_known: bool, limits_given: bool, fuel_given: bool) -> list[str]:
    """What nobody has said enough for, a line each."""
    lines = []
    if not ground_known:
        lines.append("height above ground: name it with --terrain FILE or --scenario S")
    if not limits_given:
        lines.append("obstacles, area, leg lengths and turn angles: --scenario S has limits for them")
    if not fuel_given:
        lines.append("endurance and range: --endurance MIN, --range KM")
    return lines


def _show(files: "Sequence[MissionFile]", checked: "Checked", unchecked: Sequence[str]) -> None:
    from rich.markup import escape
    from rich.table import Table

    from gcs.cli import output

    for one in files:
        for note in one.notes:
            output.out.print(f"{one.path}: {note}", soft_wrap=True, markup=False)
    if checked.figures:
        table = Table(title="Flights", title_justify="left")
        dialects = {one.path: one.autopilot or "-" for one in files}
        for index, heading in enumerate(("file", "for", "items", "km", "min")):
            table.add_column(heading, justify="right" if index else "left", overflow="fold")
        for figures in checked.figures:
            km, minutes = f"{figures.length_m / 1000:.2f}", f"{figures.duration_s / 60:.1f}"
            table.add_row(escape(figures.file.name), dialects[figures.file], str(figures.items), km, minutes)
        output.out.print(table)
    if checked.problems:
        table = Table(title=f"Problems: {len(checked.problems)}", title_justify="left")
        table.add_column("file", overflow="fold")
        table.add_column("item", justify="right")
        table.add_column("what", overflow="fold", min_width=16)
        for heading in ("value", "limit"):
            table.add_column(heading, justify="right")
        for problem in checked.problems:
            item = "" if problem.item is None else str(problem.item)
            cells = (Path(problem.file).name, item, problem.what, problem.value, problem.limit)
            table.add_row(*map(escape, cells))
        output.out.print(table)
    else:
        output.out.print("[green]No problems.[/green]")
    for line in unchecked:
        output.out.print(f"Not checked: {line}", soft_wrap=True, markup=False)


def _as_json(files: "Sequence[MissionFile]", checked: "Checked", unchecked: Sequence[str]) -> dict[str, Any]:
    return {
        "flights": [
            {
                "file": str(one.file),
                "items": one.items,
                "length_km": one.length_m / 1000.0,
                "duration_s": one.duration_s,
            }
            for one in checked.figures
        ],
        "dialects": {str(one.path): one.autopilot for one in files},
        "problems": [problem.as_json() for problem in checked.problems],
        "not_checked": list(unchecked),
        "notes": {str(one.path): list(one.notes) for one in files},
    }
