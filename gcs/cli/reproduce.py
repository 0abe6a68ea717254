"""`skein reproduce`: the paper's figures 4 to 12 and its tables 3 and 6."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from gcs.cli.errors import exit_codes
from gcs.cli.options import DarkOption, JsonOption, SeedOption
from gcs.theme import drawn_dark

if TYPE_CHECKING:
    from gcs.reproduction import Reproduced
    from missions.scenario import Scenario

SCENARIOS = ("mountains", "radars")
"""Those of the paper, 1 and 2."""

OutOption = Annotated[Path, typer.Option("--out", metavar="DIR", help="New folder for figures and numbers.")]
SeedsOption = Annotated[
    int, typer.Option("--seeds", min=1, metavar="N", help="Searches of each kind that are compared.")
]
IterationsOption = Annotated[
    int | None, typer.Option("--iterations", min=1, metavar="N", help="Of the hybrid, for a quick look.")
]
CountOption = Annotated[
    int | None, typer.Option("--count", metavar="N", min=1, help="Only the first N vehicles, for a quick look.")
]
NoFlightsOption = Annotated[bool, typer.Option("--no-flights", help="Show the plans; fly nothing.")]


def reproduce(
    out: OutOption = Path("reproduction"),
    seed: SeedOption = None,
    seeds: SeedsOption = 10,
    iterations: IterationsOption = None,
    count: CountOption = None,
    no_flights: NoFlightsOption = False,
    dark: DarkOption = False,
    json: JsonOption = False,
) -> None:
    """Make the paper's figures 4 to 12 and tables 3 and 6 again.

    Its two scenarios are planned, flown and compared as the paper does.

    docs/reproduction.md says what agrees with the paper, what cannot, and why.

    Example: skein reproduce --seeds 2 --out quick
    """
    with exit_codes(), drawn_dark(dark):
        from gcs.cli.progress import working

        with working("Loading planner and simulation", brief=True):
            from gcs.cli import output
            from gcs.cli.reproduction_tables import distance_table, method_table
            from gcs.figures.paper import draw_paper
            from gcs.reproduction import summary
            from gcs.run_folder import make_run_folder
            from missions.scenario import load_scenario

        folder = make_run_folder(out, "reproduction")
        results: list[dict[str, Any]] = []
        for name in SCENARIOS:
            scenario = _cut_down(load_scenario(name), iterations, count)
            first = scenario.seed if seed is None else seed
            reproduced = _reproduced(scenario, range(first, first + seeds), flights=not no_flights)
            with working(f"Drawing {name}"):
                files = draw_paper(reproduced, folder.path)
            results.append(summary(reproduced) | {"figures": [file.name for file in files]})
            if not json:
                output.out.print(distance_table(results[-1]))
                output.out.print(method_table(results[-1]))
        folder.write_json("reproduction.json", results)
        if json:
            output.print_json(results)
        else:
            output.out.print(f"Figures and numbers: {folder.path}", soft_wrap=True)


def _cut_down(scenario: "Scenario", iterations: int | None, count: int | None) -> "Scenario":
    search = scenario.search if iterations is None else scenario.search.model_copy(update={"iterations": iterations})
    return scenario.model_copy(update={"search": search, "vehicles": scenario.vehicles[:count]})


def _reproduced(scenario: "Scenario", seeds: range, *, flights: bool) -> "Reproduced":
    """Plan, fly and compare, with progress on standard error."""
    from gcs.cli import output
    from gcs.cli.planning import search_with_progress
    from gcs.cli.progress import working
    from gcs.reproduction import Reproduced, fly_for_the_record
    from planner.reproduction import study

    hybrid, skein = (search_with_progress(scenario, seeds[0], method) for method in ("hybrid", "skein"))
    flown = fly_for_the_record(scenario, hybrid, output.progress.print) if flights else None
    with working(f"Comparing methods on {scenario.name}") as bar:
        compared = study(scenario, seeds, lambda part: bar.show(part, 1.0))
    return Reproduced(scenario, hybrid, skein, flown, compared)
