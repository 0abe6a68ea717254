"""`skein fly`: fly the plan of a run on simulated vehicles."""

from typing import TYPE_CHECKING

from gcs.cli.errors import exit_codes
from gcs.cli.options import (
    DelayOption,
    JsonOption,
    NoCorrectionsOption,
    NoNeighboursOption,
    RealTimeOption,
    RunArgument,
    SpeedOption,
    chosen_arm,
    clock_speed,
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
    real_time: RealTimeOption = False,
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
            speed=clock_speed(speed, real_time),
            real_time=real_time,
        )
        fly_and_report(folder, scenario, plan, options, json)


def fly_and_report(
    run: "RunFolder", scenario: "Scenario", plan: "FormationPlan", options: "FlightOptions", json: bool
) -> None:
    """Fly with a live table on standard error, write metrics and figures, print the report; exit with 1 if something
    fell short."""
    import asyncio

    from gcs.cli import output
    from gcs.cli.flight_report import show_report, warn_of_delay
    from gcs.cli.live import LiveTable
    from gcs.flight import fly as fly_plan
    from gcs.report import write_report

    warn_of_delay(scenario, options.delay_s, options.arm)
    with LiveTable(output.progress) as live:
        record = asyncio.run(fly_plan(scenario, plan, run, options, live.announce, live.show))
    output.progress.print("Computing figures of merit, drawing")
    show_report(write_report(run, scenario, plan, record), run, json)
