"""Options that several commands share."""

import math
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from gcs.cli import completion

if TYPE_CHECKING:
    from sitl.config import Arm


def finite(value: float | None) -> float | None:
    """An option's number, if it is one."""
    if value is not None and not math.isfinite(value):
        raise typer.BadParameter(f"{value} is not a finite number")
    return value


ScenarioArgument = Annotated[
    str,
    typer.Argument(
        metavar="[SCENARIO|FILE]",
        help="A scenario that ships (crossing, mountains, radars, ridge, vee) or a TOML file.",
        autocompletion=completion.scenarios,
    ),
]
RunArgument = Annotated[
    Path,
    typer.Argument(metavar="RUN", help="Folder of a run, as made by `skein plan`.", autocompletion=completion.runs),
]
OutOption = Annotated[Path | None, typer.Option("--out", metavar="DIR", help="New folder for the run.")]
SeedOption = Annotated[
    int | None, typer.Option("--seed", min=0, max=2**63 - 1, metavar="N", help="Seed of search and gusts.")
]
DarkOption = Annotated[bool, typer.Option("--dark", help="Draw pictures light on dark.")]
JsonOption = Annotated[bool, typer.Option("--json", help="Print JSON on standard output, and nothing else there.")]
DelayOption = Annotated[
    float | None,
    typer.Option(
        "--delay", metavar="S", min=0.0, max=60.0, callback=finite, help="Delay of the corrections in seconds."
    ),
]
NoCorrectionsOption = Annotated[
    bool, typer.Option("--no-corrections", help="Fly plain autopilots: no schedule, no neighbours.")
]
NoNeighboursOption = Annotated[bool, typer.Option("--no-neighbours", help="Keep the own schedule, hear no neighbours.")]
SpeedOption = Annotated[
    float,
    typer.Option(
        "--speed", metavar="X", min=0.0, callback=finite, help="Simulated seconds a second; 0 for as fast as it goes."
    ),
]
RealTimeOption = Annotated[
    bool,
    typer.Option(
        "--real-time",
        help="The simulated clock is the wall's (times --speed, 1 unless given), and nobody waits for anybody: samples "
        "may come late or get lost, and are counted. Else vehicles keep in lockstep, and a flight repeats exactly.",
    ),
]


def clock_speed(speed: float, real_time: bool) -> float:
    """The factor of the clock: of 0, as fast as it goes, or in real time the wall's."""
    return speed or (1.0 if real_time else math.inf)


def chosen_arm(no_corrections: bool, no_neighbours: bool) -> "Arm":
    """How much of the formation law is on. Raises InputError when both options were given."""
    from missions.errors import InputError

    if no_corrections and no_neighbours:
        raise InputError("--no-corrections and --no-neighbours: choose one of them")
    if no_corrections:
        return "plain"
    return "own_schedule" if no_neighbours else "full"
