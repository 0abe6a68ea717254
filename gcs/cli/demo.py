"""`skein demo`: the whole way in one go."""

from gcs.cli.errors import exit_codes
from gcs.cli.options import (
    DarkOption,
    DelayOption,
    JsonOption,
    NoCorrectionsOption,
    NoNeighboursOption,
    OutOption,
    RealTimeOption,
    ScenarioArgument,
    SeedOption,
    SpeedOption,
    chosen_arm,
    clock_speed,
)
from gcs.theme import drawn_dark


def demo(
    scenario: ScenarioArgument = "radars",
    out: OutOption = None,
    seed: SeedOption = None,
    delay: DelayOption = None,
    no_corrections: NoCorrectionsOption = False,
    no_neighbours: NoNeighboursOption = False,
    speed: SpeedOption = 0.0,
    real_time: RealTimeOption = False,
    dark: DarkOption = False,
    json: JsonOption = False,
) -> None:
    """Plan, upload, fly and report, on simulated vehicles.

    The missions go over MAVLink, the vehicles keep formation over Zenoh.

    Example: skein demo vee --delay 0.4
    """
    with exit_codes(), drawn_dark(dark):
        from gcs.cli.progress import working

        with working("Loading planner and simulation"):
            from gcs.cli import output
            from gcs.cli.fly import fly_and_report
            from gcs.cli.plan import plan_run
            from gcs.cli.tables import plan_table
            from gcs.flight import FlightOptions

        arm = chosen_arm(no_corrections, no_neighbours)
        run, loaded, plan = plan_run(scenario, out, seed)
        if not json:
            output.out.print(plan_table(plan, loaded))
        options = FlightOptions(
            delay_s=loaded.formation.delay_s if delay is None else delay,
            arm=arm,
            speed=clock_speed(speed, real_time),
            real_time=real_time,
        )
        fly_and_report(run, loaded, plan, options, json)
