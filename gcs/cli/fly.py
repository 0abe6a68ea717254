"""`skein fly`: fly the plan of a run on simulated vehicles."""

from typing import TYPE_CHECKING, Annotated

import typer

from gcs.cli.errors import FELL_SHORT, exit_codes
from gcs.cli.options import (
    DarkOption,
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
from gcs.cli.station import KeyOption
from gcs.theme import drawn_dark

FlyConnectOption = Annotated[
    list[str] | None,
    typer.Option(
        "--connect",
        metavar="URL",
        help="Fly vehicles that are there instead of simulating some: real ones, or `skein sim --no-corrections`. "
        "Links as of `skein upload`; system ids as in the plan.",
    ),
]

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

    from gcs.companion.connected_flight import Arrival
    from gcs.flight import FlightOptions
    from gcs.run_folder import RunFolder
    from missions.scenario import Scenario
    from planner.formation_plan import FormationPlan


def fly(
    run: RunArgument,
    connect: FlyConnectOption = None,
    signing_key: KeyOption = None,
    delay: DelayOption = None,
    no_corrections: NoCorrectionsOption = False,
    no_neighbours: NoNeighboursOption = False,
    speed: SpeedOption = 0.0,
    real_time: RealTimeOption = False,
    dark: DarkOption = False,
    json: JsonOption = False,
) -> None:
    """Fly a planned run, simulated or on vehicles that are there.

    An earlier flight in the same run is replaced.

    With --connect, fly it on vehicles that are there: wait until they are ready, upload and verify, start all within a
    second, and keep them together by airspeeds (docs/companion.md).

    Example: skein fly runs/first --delay 0.4

    Example: skein fly runs/first --connect udpin://127.0.0.1:14550
    """
    with exit_codes(), drawn_dark(dark):
        from gcs.cli.progress import working

        with working("Loading simulation", brief=True):
            from gcs.flight import FlightOptions
            from gcs.run_folder import RunFolder
            from missions.errors import InputError

        folder = RunFolder(run)
        scenario, plan = folder.read()
        if connect:
            if delay is not None or no_corrections or no_neighbours or speed or real_time:
                raise InputError("--connect: the vehicles have clocks of their own, and laws; leave other options out")
            fly_connected_and_report(scenario, plan, connect, signing_key, json)
            return
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
    import logging

    from gcs.cli import output
    from gcs.cli.flight_report import show_report, warn_of_delay
    from gcs.cli.live import LiveTable
    from gcs.cli.progress import working
    from gcs.flight import fly as fly_plan
    from gcs.report import write_report

    warn_of_delay(scenario, options.delay_s, options.arm)
    logging.getLogger(__name__).info("%s: seed %d, %s", run.path, plan.seed, options)
    with LiveTable(output.progress) as live:
        record = asyncio.run(fly_plan(scenario, plan, run, options, live.announce, live.show))
    with working("Computing figures of merit, drawing"):
        report = write_report(run, scenario, plan, record)
    show_report(report, run, json)


def fly_connected_and_report(
    scenario: "Scenario", plan: "FormationPlan", urls: list[str], signing_key: "Path | None", json: bool
) -> None:
    """Fly with a live table on standard error and print how each arrived; exit with 1 if one did not."""
    import asyncio
    from dataclasses import asdict

    from gcs.cli import output
    from gcs.cli.live import LiveTable
    from gcs.cli.station import signing_of
    from gcs.cli.tables import arrival_table
    from gcs.companion.connected_flight import Arrival, fly_connected
    from gcs.companion.run import Companionship
    from gcs.fleet import Fleet
    from gcs.links.open_link import open_link
    from gcs.station_logs import station_logs

    async def run() -> list[Arrival]:
        async with Fleet(station_logs(), signing=signing_of(signing_key), announce=output.progress.print) as fleet:
            for url in urls:
                fleet.attach(await open_link(url))
            return await fly_connected(Companionship(scenario, plan), fleet, live.announce, live.show)

    with LiveTable(output.progress) as live:
        arrivals = asyncio.run(run())
    if json:
        output.print_json({"vehicles": [asdict(one) for one in arrivals], "arrival_spread_s": spread_s(arrivals)})
    else:
        output.out.print(arrival_table(arrivals, spread_s(arrivals)))
    if any(one.arrived_s is None for one in arrivals):
        raise SystemExit(FELL_SHORT)


def spread_s(arrivals: "Sequence[Arrival]") -> float | None:
    """From the earliest to the latest against the plan; None when nobody arrived."""
    late = [one.arrived_s - one.planned_s for one in arrivals if one.arrived_s is not None]
    return max(late) - min(late) if late else None
