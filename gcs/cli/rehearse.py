"""`skein rehearse`: fly a plan in one process, without endpoints."""

from typing import TYPE_CHECKING, Annotated

import typer

from gcs.cli.errors import exit_codes
from gcs.cli.options import (
    DelayOption,
    JsonOption,
    NoCorrectionsOption,
    NoNeighboursOption,
    OutOption,
    chosen_arm,
)

if TYPE_CHECKING:
    from gcs.rehearsal import RehearsalOptions
    from gcs.run_folder import RunFolder
    from missions.scenario import Scenario
    from planner.formation_plan import FormationPlan

SourceArgument = Annotated[
    str,
    typer.Argument(
        metavar="SCENARIO|FILE|RUN", help="A scenario that ships, a TOML file, or the folder of a planned run."
    ),
]
SeedOption = Annotated[
    int | None,
    typer.Option(
        "--seed", min=0, max=2**63 - 1, metavar="N", help="Seed of search and gusts; of gusts alone with a planned run."
    ),
]


def rehearse(
    source: SourceArgument = "radars",
    seed: SeedOption = None,
    delay: DelayOption = None,
    no_corrections: NoCorrectionsOption = False,
    no_neighbours: NoNeighboursOption = False,
    out: OutOption = None,
    json: JsonOption = False,
) -> None:
    """Fly a plan in this process, thousands of times faster than real time: bit for bit as `skein fly` flies it.

    Nothing is kept without --out.

    Example: skein rehearse runs/first --delay 0.4
    """
    with exit_codes():
        from gcs.cli.planning import plan_of
        from gcs.rehearsal import RehearsalOptions
        from gcs.run_folder import make_run_folder

        arm = chosen_arm(no_corrections, no_neighbours)
        run = None if out is None else make_run_folder(out, "rehearsal")
        try:
            text, scenario, plan = plan_of(source, seed)
        except BaseException:
            if run is not None:
                run.discard_if_empty()
            raise
        if run is not None:
            run.write_plan(text, scenario, plan)
        options = RehearsalOptions(
            seed=plan.seed if seed is None else seed,
            delay_s=scenario.formation.delay_s if delay is None else delay,
            arm=arm,
        )
        rehearse_and_report(run, scenario, plan, options, json)


def rehearse_and_report(
    run: "RunFolder | None", scenario: "Scenario", plan: "FormationPlan", options: "RehearsalOptions", json: bool
) -> None:
    """Rehearse, keep truth, metrics and figures if there is a run for them, print the report; exit with 1 if something
    fell short."""
    from gcs.cli import output
    from gcs.cli.flight_report import show_report, warn_of_delay
    from gcs.rehearsal import compile_rehearsal, rehearse_plan
    from gcs.report import keep_report, report_on
    from gcs.truth import write_truths
    from planner.verify import require, verify

    warn_of_delay(scenario, options.delay_s, options.arm)
    require(verify(plan, scenario))
    with output.progress.status("Compiling the rehearsal, which takes some 20 s the first time"):
        compile_s = compile_rehearsal(scenario, plan)
    truths, record = rehearse_plan(scenario, plan, options, compile_s)
    report = report_on(scenario, plan, truths, record)
    if run is not None:
        run.begin_flight()
        write_truths(truths, run.truth)
        keep_report(run, scenario, plan, truths, report)
    show_report(report, run, json)
