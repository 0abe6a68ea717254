"""Flying what a campaign's table lacks."""

from collections.abc import Callable

from gcs.campaign.campaign import Campaign
from gcs.campaign.case import Case, Flown, make_course
from gcs.campaign.table import Table
from gcs.rehearsal import compile_rehearsal
from planner.jobs.run_jobs import Failure, Workers, run_jobs
from planner.verify import require, verify


def missing_cases(campaign: Campaign, table: Table) -> list[Case]:
    """Flights of which there are no rows."""
    return [case for case in campaign.cases() if table.row_of(case) is None]


def fly_campaign(
    campaign: Campaign, table: Table, workers: Workers, done: Callable[[Flown | Failure[Case]], None]
) -> None:
    """Fly every case that has no row yet, add its row, and tell of it.

    Raises:
        InputError: the plan does not verify, or is more than a rehearsal flies.
    """

    def keep(result: Flown | Failure[Case]) -> None:
        if isinstance(result, Flown):
            table.append(result)
        done(result)

    require(verify(campaign.plan, campaign.scenario))
    cases = missing_cases(campaign, table)
    if cases:
        compile_rehearsal(campaign.scenario, campaign.plan)  # once, before processes would do it at the same time
        run_jobs(cases, workers, make_course(campaign.scenario, campaign.plan).fly, keep)
