"""Flying a campaign with a progress bar, and saying what it came to."""

from dataclasses import asdict
from typing import TYPE_CHECKING

from gcs.cli.errors import FELL_SHORT

if TYPE_CHECKING:
    from gcs.campaign.campaign import Campaign
    from gcs.campaign.table import Table
    from gcs.run_folder import RunFolder
    from planner.jobs.run_jobs import Workers


def fly_and_summarise(
    run: "RunFolder", campaign: "Campaign", scenario_text: str, workers: "Workers", *, parquet: bool, json: bool
) -> None:
    """Fly what is missing in a campaign's folder, draw, print a table; exit with 1 if a flight gave no result.

    Raises:
        InputError: the folder is another campaign's, or a flight cannot be rehearsed.
    """
    from gcs.campaign.folder import claim
    from gcs.campaign.parquet import require_parquet, write_parquet
    from gcs.campaign.summary import summarise
    from gcs.campaign.table import Table
    from gcs.cli import output
    from gcs.cli.campaign_table import campaign_table, legend
    from gcs.cli.progress import working
    from gcs.figures.campaign import draw_campaign

    if parquet:
        require_parquet()
    with Table(claim(run, campaign, scenario_text), list(campaign.axes)) as table:
        try:
            failures = _with_progress(campaign, table, workers)
        except KeyboardInterrupt:
            output.progress.print(f"{len(table.rows)} flights are kept; the same command with --out {run.path} goes on")
            raise
        with working("Drawing", brief=True):
            settings = summarise(campaign, table)
            files = draw_campaign(campaign, table, run.figures)
        if parquet:
            files.append(write_parquet(table, run.path / "runs.parquet"))
    if json:
        output.print_json(
            {
                "campaign": str(run.path),
                "flights": sum(setting.flights for setting in settings),
                "failed": failures,
                "settings": [asdict(setting) for setting in settings],
            }
        )
    else:
        output.print_wide(campaign_table(campaign, settings))
        for line in legend(campaign):
            output.out.print(line, markup=False, soft_wrap=True)
        for file in (run.path / "runs.csv", *files):
            output.out.print(str(file), soft_wrap=True)
    if failures:
        raise SystemExit(FELL_SHORT)


def _with_progress(campaign: "Campaign", table: "Table", workers: "Workers") -> int:
    """Fly what is missing; returns how many flights gave no result, each of which is told of."""
    from gcs.campaign.case import Case, Flown
    from gcs.campaign.fly import fly_campaign, missing_cases
    from gcs.cli import output
    from gcs.cli.progress import working
    from planner.jobs.run_jobs import Failure

    failures = 0
    total, missing = len(list(campaign.cases())), len(missing_cases(campaign, table))
    name = campaign.scenario.name
    with working(f"Rehearsing {name}, after compiling", count=total, done=total - missing) as bar:

        def done(result: Flown | Failure[Case]) -> None:
            nonlocal failures
            bar.advance(f"Rehearsing {name}")
            if isinstance(result, Failure):
                failures += 1
                output.progress.print(f"No result: seed {result.job.seed}: {result.reason}", markup=False)

        fly_campaign(campaign, table, workers, done)
    return failures
