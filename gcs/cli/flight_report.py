"""What commands say of a flight, before it and after it: tables for people, or JSON."""

from gcs.cli import output
from gcs.cli.errors import FELL_SHORT
from gcs.cli.tables import flight_table, formation_table, link_table
from gcs.delay_margin import delay_margin_s
from gcs.report import Report
from gcs.run_folder import RunFolder
from missions.scenario import Scenario
from sitl.config import Arm


def warn_of_delay(scenario: Scenario, delay_s: float, arm: Arm) -> None:
    """Say on standard error when a delay is past the formation's margin."""
    if arm == "full" and delay_s >= (margin_s := delay_margin_s(scenario)):
        output.progress.print(f"The delay of {delay_s:g} s is past the formation's margin of {margin_s:.2f} s")


def show_report(report: Report, run: RunFolder | None, json: bool) -> None:
    """Print what a flight came to, and where its run is kept, if it is; exit with 1 if something fell short."""
    if json:
        output.print_json({"run": str(run.path) if run else None, **report.metrics})
    else:
        output.out.print(flight_table(report.metrics))
        output.out.print(formation_table(report.metrics))
        if links := link_table(report.metrics):
            output.out.print(links)
        for line in report.shortfalls:
            output.out.print(f"[red]Fell short:[/red] {line}")
        if run:
            output.out.print(f"Run:     {run.path}", soft_wrap=True)
            output.out.print(f"Figures: {run.figures}", soft_wrap=True)
    if report.shortfalls:
        raise SystemExit(FELL_SHORT)
