"""`skein report`: a flight as one page for the browser."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from gcs.cli.errors import exit_codes
from gcs.cli.options import JsonOption, RunArgument
from gcs.cli.workers import JobsOption

if TYPE_CHECKING:
    from gcs.report_page.delays import DelayPoint
    from gcs.report_page.flown_run import FlownRun

CompareOption = Annotated[
    Path | None, typer.Option("--compare", metavar="RUN2", help="Put a second run beside the first.")
]
PageOption = Annotated[
    Path | None, typer.Option("--out", metavar="FILE", help="The page; RUN/report.html unless given.")
]
NoDelaysOption = Annotated[
    bool, typer.Option("--no-delays", help="Leave out the rehearsals that show how much delay the formation bears.")
]


def report(
    run: RunArgument,
    compare: CompareOption = None,
    out: PageOption = None,
    no_delays: NoDelaysOption = False,
    jobs: JobsOption = None,
    json: JsonOption = False,
) -> None:
    """Write a flown run as one HTML page that needs no network.

    It has checks, scene, figures, tables, and how to fly it again.

    Example: skein report runs/first
    """
    with exit_codes():
        from gcs.cli.progress import working

        with working("Loading", brief=True):
            from gcs.cli import output
            from gcs.report_page import read_flown_run, write_page

            runs = [read_flown_run(path) for path in (run, compare) if path is not None]
        curves = _curves(runs, jobs) if not no_delays else [[] for _ in runs]
        file = out or run / "report.html"
        with working("Drawing", brief=True):
            write_page(list(zip(runs, curves, strict=True)), file)
        if json:
            output.print_json({"report": str(file)})
        else:
            output.out.print(f"Report: {file}", markup=False, soft_wrap=True)


def _curves(runs: "list[FlownRun]", jobs: int | None) -> "list[list[DelayPoint]]":
    """Rehearse each run at other delays."""
    from gcs.cli.progress import working
    from gcs.cli.workers import chosen_workers
    from gcs.report_page.delays import delay_curve, delay_trials_of

    trials = [delay_trials_of(run) for run in runs]
    workers = chosen_workers(jobs, None)
    with working("Rehearsing at other delays", count=sum(map(len, trials))) as bar:
        return [
            delay_curve(run, some, workers, bar.advance) if some else [] for run, some in zip(runs, trials, strict=True)
        ]
