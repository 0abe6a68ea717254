"""`skein fly`: fly the plan of a run on simulated vehicles."""

from typing import TYPE_CHECKING

from gcs.cli.errors import FELL_SHORT, exit_codes
from gcs.cli.options import (
    DelayOption,
    JsonOption,
    NoCorrectionsOption,
    NoNeighboursOption,
    RunArgument,
    SpeedOption,
    chosen_arm,
)

if TYPE_CHECKING:
    from gcs.flight import FlightOptions
    from gcs.run_folder import RunFolder
    from missions.scenario import Scenario
    from planner.formation_plan import FormationPlan


def fly(
    run: RunArgument,
    delay: DelayOption = None,
    no_corrections: NoCorrectionsOption = False,
    no_neighbours: NoNeighboursOption = False,
    speed: SpeedOption = 0.0,
    json: JsonOption = False,
) -> None:
    """Fly a planned run on simulated vehicles and report; an earlier flight in the same run is replaced.

    Example: skein fly runs/first --delay 0.4
    """
    with exit_codes():
        from gcs.flight import FlightOptions
        from gcs.run_folder import RunFolder

        folder = RunFolder(run)
        scenario, plan = folder.read()
        options = FlightOptions(
            delay_s=scenario.formation.delay_s if delay is None else delay,
            arm=chosen_arm(no_corrections, no_neighbours),
            speed=speed or float("inf"),
        )
        fly_and_report(folder, scenario, plan, options, json)


def fly_and_report(
    run: "RunFolder", scenario: "Scenario", plan: "FormationPlan", options: "FlightOptions", json: bool
) -> None:
    """Fly with a live table on standard error, write metrics and figures, print the report; exit with 1 if something
    fell short."""
    import asyncio

    from gcs.cli import output
    from gcs.cli.live import LiveTable
    from gcs.cli.tables import flight_table, formation_table
    from gcs.flight import delay_margin_s
    from gcs.flight import fly as fly_plan
    from gcs.report import write_report

    if options.arm == "full" and options.delay_s >= (margin_s := delay_margin_s(scenario)):
        output.progress.print(f"The delay of {options.delay_s:g} s is past the formation's margin of {margin_s:.2f} s")
    with LiveTable(output.progress) as live:
        record = asyncio.run(fly_plan(scenario, plan, run, options, live.announce, live.show))
    output.progress.print("Computing figures of merit, drawing")
    report = write_report(run, scenario, plan, record)
    if json:
        output.print_json({"run": str(run.path), **report.metrics})
    else:
        output.out.print(flight_table(report.metrics))
        output.out.print(formation_table(report.metrics))
        for line in report.shortfalls:
            output.out.print(f"[red]Fell short:[/red] {line}")
        output.out.print(f"Run:     {run.path}", soft_wrap=True)
        output.out.print(f"Figures: {run.figures}", soft_wrap=True)
    if report.shortfalls:
        raise SystemExit(FELL_SHORT)
