"""`skein import`: mission files of other stations read, and written as this one writes them."""

from collections.abc import Sequence
from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from gcs.cli.errors import exit_codes
from gcs.cli.options import JsonOption

if TYPE_CHECKING:
    from missions.formats.mission_file import MissionFile


class ComplexChoice(StrEnum):
    """What is done with complex items."""

    refuse = "refuse"
    skip = "skip"
    expand = "expand"


FilesArgument = Annotated[
    list[Path], typer.Argument(metavar="FILE", help=".plan, .mission or .waypoints files of any station.")
]
HomeOption = Annotated[
    str | None, typer.Option("--home", metavar="LAT,LON,ALT", help="Home in place of the files', metres above sea.")
]
ComplexOption = Annotated[
    ComplexChoice,
    typer.Option(
        "--complex",
        help="Surveys and other complex items: refuse the file, skip them, or expand to the items kept of a survey.",
    ),
]
FolderOption = Annotated[
    Path | None, typer.Option("--out", metavar="DIR", help="Write each as DIR/<name>.plan; else they are only read.")
]
ScenarioOption = Annotated[
    bool, typer.Option("--as-scenario", help="Write a scenario from the homes to the last places, for `skein plan`.")
]
TerrainOption = Annotated[
    Path | None, typer.Option("--terrain", metavar="FILE", help="The ground: a .tif, .hgt or .npz elevation file.")
]


def import_files(
    files: FilesArgument,
    out: FolderOption = None,
    as_scenario: ScenarioOption = False,
    home: HomeOption = None,
    complex_items: ComplexOption = ComplexChoice.refuse,
    terrain: TerrainOption = None,
    json: JsonOption = False,
) -> None:
    """Read mission files of other ground stations.

    Say what was read, and write them for vehicles and planning.

    Example: skein import old.waypoints survey.plan --complex skip --out imported
    """
    with exit_codes():
        from gcs.cli import output
        from missions.errors import InputError

        if terrain is not None and not as_scenario:
            raise InputError("--terrain goes into a scenario; say --as-scenario, too")
        found = read_files(files, home, complex_items)
        named = names_of(found)
        written = _write_plans(found, named, out) if out is not None else []
        if as_scenario:
            written.append(_write_scenario(found, named, out or Path(), terrain))
        if json:
            output.print_json({"files": [_as_json(one) for one in found], "written": list(map(str, written))})
            return
        output.out.print(_table(found))
        for one in found:
            for note in one.notes:
                output.out.print(f"{one.path}: {note}", soft_wrap=True, markup=False)
        for path in written:
            output.out.print(f"Written: {path}", soft_wrap=True, markup=False)


def read_files(
    files: Sequence[Path], home: str | None, complex_items: ComplexChoice = ComplexChoice.refuse
) -> "list[MissionFile]":
    """All of them. Raises InputError."""
    from missions.formats.mission_file import home_at, read_mission_file

    place = None if home is None else home_at(home)
    return [read_mission_file(path, home=place, complex_items=complex_items.value) for path in files]


def names_of(files: "Sequence[MissionFile]") -> list[str]:
    """What vehicles and files written are called: the files' names. Raises InputError when two are the same."""
    from missions.errors import InputError
    from missions.scenario.around import tidy

    names = [tidy(one.path.stem) for one in files]
    for index, name in enumerate(names):
        if (first := names.index(name)) < index:
            raise InputError(f"{files[index].path}: would be called {name}, as {files[first].path}; rename one of them")
    return names


def _write_plans(files: "Sequence[MissionFile]", names: Sequence[str], folder: Path) -> list[Path]:
    from gcs.cli.download import CRUISE_SPEED_M_S
    from missions.errors import InputError
    from missions.formats.qgc_plan import write_plan

    paths = [folder / f"{name}.plan" for name in names]
    for path in paths:
        if any(path.resolve() == one.path.resolve() for one in files):
            raise InputError(f"{path}: is one of the files read; choose another folder with --out")
    folder.mkdir(parents=True, exist_ok=True)
    for one, path in zip(files, paths, strict=True):
        write_plan(one.plan, path, cruise_speed_m_s=CRUISE_SPEED_M_S)
    return paths


def _write_scenario(files: "Sequence[MissionFile]", names: Sequence[str], folder: Path, terrain: Path | None) -> Path:
    """A scenario that has been read back. Raises InputError."""
    from missions.formats.files import write_text
    from missions.scenario import parse_scenario
    from missions.scenario.around import Named, scenario_around

    missions = [Named(name, one.plan.mission) for name, one in zip(names, files, strict=True)]
    text = scenario_around(missions, names[0], terrain=None if terrain is None else str(terrain.resolve()))
    path = folder / f"{names[0]}.toml"
    parse_scenario(text, str(path), folder)
    folder.mkdir(parents=True, exist_ok=True)
    write_text(path, text)
    return path


def _table(files: "Sequence[MissionFile]") -> Any:
    from rich.markup import escape
    from rich.table import Table

    table = Table(title="Read", title_justify="left")
    for index, heading in enumerate(("file", "items", "fence areas", "rally points", "notes")):
        table.add_column(heading, justify="right" if index else "left", overflow="fold")
    for one in files:
        counts = (len(one.plan.mission), len(one.plan.fence.areas), len(one.plan.rally), len(one.notes))
        table.add_row(escape(str(one.path)), *map(str, counts))
    return table


def _as_json(one: "MissionFile") -> dict[str, Any]:
    return {
        "file": str(one.path),
        "items": len(one.plan.mission),
        "fence_areas": len(one.plan.fence.areas),
        "rally_points": len(one.plan.rally),
        "notes": list(one.notes),
    }
