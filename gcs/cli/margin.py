"""`skein margin`: how late corrections may come."""

from enum import StrEnum
from typing import Annotated

import typer

from gcs.cli.errors import exit_codes
from gcs.cli.options import JsonOption, ScenarioArgument, finite


class Graph(StrEnum):
    """Graphs by name."""

    ring = "ring"
    line = "line"
    star = "star"
    complete = "complete"


def _gain(name: str, unit: str) -> typer.models.OptionInfo:
    option: typer.models.OptionInfo = typer.Option(
        f"--{name}", metavar="X", min=0.0, callback=finite, help=f"Gain {name} ({unit}); the scenario's unless given."
    )
    return option


SuggestOption = Annotated[
    float | None,
    typer.Option(
        "--suggest",
        metavar="DELAY",
        min=0.0,
        max=60.0,
        callback=finite,
        help="Suggest gains for this delay in seconds; the scenario's unless given.",
    ),
]
LinearOption = Annotated[
    bool, typer.Option("--linear", help="The bare law (15): unit weights, no k0 unless given, h_p switches k3.")
]
GraphOption = Annotated[Graph | None, typer.Option("--graph", help="Another graph than the scenario's.")]
CountOption = Annotated[
    int | None, typer.Option("--count", metavar="N", min=2, max=250, help="Another number of vehicles.")
]
PinnedOption = Annotated[
    str | None, typer.Option("--pinned", metavar="SYSIDS", help="Vehicles with h_p = 1: all, none, or such as 1,5.")
]


def margin(
    scenario: ScenarioArgument = "radars",
    linear: LinearOption = False,
    graph: GraphOption = None,
    count: CountOption = None,
    pinned: PinnedOption = None,
    k1: Annotated[float | None, _gain("k1", "1/s^2")] = None,
    k2: Annotated[float | None, _gain("k2", "1/s")] = None,
    k3: Annotated[float | None, _gain("k3", "1/s")] = None,
    k0: Annotated[float | None, _gain("k0", "1/s^2")] = None,
    suggest: SuggestOption = None,
    json: JsonOption = False,
) -> None:
    """Say how late corrections may come, and which gains suit.

    Beyond the margin the formation rings.

    Example: skein margin --linear --graph complete --k1 0.2 --k2 1 --k3 1
    """
    with exit_codes():
        from gcs.cli.progress import working

        with working("Loading", brief=True):
            from gcs.cli import output
            from gcs.cli.margin_tables import gains_table, limiting_line, margin_table, title_line
            from gcs.margin import MarginStudy
            from missions.scenario import load_scenario

        loaded = load_scenario(scenario)
        own = [vehicle.sysid for vehicle in loaded.vehicles]
        more = range(max(own) + 1, max(own) + 1 + (count or 0))
        sysids = sorted([*own, *more][: len(own) if count is None else count])
        given = {name: gain for name, gain in (("k1", k1), ("k2", k2), ("k3", k3), ("k0", k0)) if gain is not None}
        model = loaded.formation.model_copy(update=({"k0": 0.0} if linear else {}) | given)
        if graph is not None:
            model = model.model_copy(update={"graph": graph.value})
        if pinned is not None:
            model = model.model_copy(update={"pinned": chosen_pins(pinned, sysids)})
        delay_s = model.delay_s if suggest is None else suggest
        with working("Computing margins", brief=True):
            figures = MarginStudy(model, sysids, loaded.airframe.airframe(), delay_s, bare=linear).figures()
        if json:
            output.print_json({"scenario": loaded.name, **figures})
            return
        output.out.print(title_line(loaded.name, figures), soft_wrap=True)
        output.out.print(margin_table(figures))
        output.out.print(limiting_line(figures))
        output.out.print(gains_table(figures))


def chosen_pins(text: str, sysids: list[int]) -> tuple[int, ...]:
    """The vehicles that --pinned names. Raises InputError when it names others."""
    from missions.errors import InputError

    if text in ("all", "none"):
        return tuple(sysids) if text == "all" else ()
    try:
        chosen = tuple(int(part) for part in text.split(","))
    except ValueError:
        raise InputError(f"--pinned {text}: give all, none, or system ids with commas") from None
    if strange := set(chosen) - set(sysids):
        there_are = ", ".join(map(str, sysids))
        raise InputError(f"--pinned {text}: there is no vehicle {min(strange)}; there are {there_are}")
    return chosen
