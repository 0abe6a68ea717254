"""`skein plan`: search nine paths, verify them, keep them as a run."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from gcs.cli.completion import methods
from gcs.cli.errors import exit_codes
from gcs.cli.options import DarkOption, JsonOption, OutOption, ScenarioArgument, SeedOption
from gcs.theme import drawn_dark

if TYPE_CHECKING:
    from gcs.run_folder import RunFolder
    from missions.scenario import Scenario
    from planner.formation_plan import FormationPlan

MethodOption = Annotated[
    str | None,
    typer.Option(
        "--method", metavar="M", help="Search: skein, pso, qpso, hybrid or published.", autocompletion=methods
    ),
]
FiguresOption = Annotated[
    bool, typer.Option("--figures", help="Draw the plan into the run's figures/: the scene, maps, heights.")
]


def plan(
    scenario: ScenarioArgument,
    out: OutOption = None,
    seed: SeedOption = None,
    method: MethodOption = None,
    figures: FiguresOption = False,
    dark: DarkOption = False,
    json: JsonOption = False,
) -> None:
    """Plan a path for every vehicle of a scenario and write a run.

    Example: skein plan radars --out runs/first
    """
    with exit_codes(), drawn_dark(dark):
        from gcs.cli.progress import working

        with working("Loading planner", brief=True):
            from gcs.cli import output
            from gcs.cli.plan_json import plan_json
            from gcs.cli.tables import plan_table, planned_table
            from planner.verify import verify

        run, loaded, result = plan_run(scenario, out, seed, method)
        if figures:
            with working("Drawing"):
                _draw(run, loaded, result)
        if json:
            output.print_json({"run": str(run.path), **plan_json(result, loaded)})
            return
        output.out.print(plan_table(result, loaded))
        output.out.print(planned_table(verify(result, loaded), result, loaded))
        output.out.print(f"Run:     {run.path}", soft_wrap=True)
        if figures:
            output.out.print(f"Figures: {run.figures}", soft_wrap=True)
        output.out.print(f"Fly it:  skein fly {run.path}", soft_wrap=True)


def _draw(run: "RunFolder", scenario: "Scenario", plan: "FormationPlan") -> None:
    from gcs.figures import draw_plan

    run.figures.mkdir()
    draw_plan(scenario, plan, run.figures)


def plan_run(
    name_or_file: str, out: Path | None, seed: int | None, method: str | None = None
) -> "tuple[RunFolder, Scenario, FormationPlan]":
    """Plan a scenario, showing progress on standard error, and write it to a new run.

    Raises:
        InputError: the scenario, the method or the folder cannot be used, or no path was found.
    """
    from gcs.cli.planning import search_with_progress
    from gcs.run_folder import make_run_folder
    from missions.scenario import parse_scenario, read_scenario_text, scenario_folder

    text, label = read_scenario_text(name_or_file)
    scenario = parse_scenario(text, label, scenario_folder(name_or_file))
    run = make_run_folder(out, scenario.name)
    try:
        result = search_with_progress(scenario, seed, method)
    except BaseException:
        run.discard_if_empty()
        raise
    run.write_plan(text, scenario, result)
    return run, scenario, result
