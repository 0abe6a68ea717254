"""`skein rehearse`: fly a plan in one process, without endpoints; or fly it many times, as a campaign."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from gcs.cli.completion import sources
from gcs.cli.errors import exit_codes
from gcs.cli.options import DarkOption, JsonOption, NoCorrectionsOption, NoNeighboursOption, OutOption, chosen_arm
from gcs.cli.workers import ClusterOption, JobsOption, chosen_workers
from gcs.theme import drawn_dark

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from planner.jobs.run_jobs import Workers
    from sitl.config import Arm

SourceArgument = Annotated[
    str,
    typer.Argument(
        metavar="[SCENARIO|FILE|RUN]",
        help="A scenario that ships, a TOML file, or the folder of a planned run.",
        autocompletion=sources,
    ),
]
SeedOption = Annotated[
    int | None,
    typer.Option(
        "--seed", min=0, max=2**62, metavar="N", help="Seed of search and gusts; of gusts alone with a planned run."
    ),
]
DelaysOption = Annotated[
    str | None,
    typer.Option("--delay", metavar="S,S", help="Delay of the corrections in seconds; several make a campaign."),
]
RunsOption = Annotated[
    int | None,
    typer.Option("--runs", min=1, metavar="N", help="A campaign: N flights of each kind, seeds of gusts counted up."),
]
VaryOption = Annotated[
    list[str] | None,
    typer.Option(
        "--vary", metavar="KEY=V,V", help="A campaign over a key of the scenario, such as wind.gusts=light,moderate."
    ),
]
CampaignOption = Annotated[
    Path | None, typer.Option("--campaign", metavar="FILE", help="A campaign's TOML file; docs/rehearsal.md.")
]
ParquetOption = Annotated[bool, typer.Option("--parquet", help="Write a campaign's table as Parquet as well.")]


def rehearse(
    source: SourceArgument = "radars",
    seed: SeedOption = None,
    delay: DelaysOption = None,
    no_corrections: NoCorrectionsOption = False,
    no_neighbours: NoNeighboursOption = False,
    runs: RunsOption = None,
    vary: VaryOption = None,
    campaign: CampaignOption = None,
    jobs: JobsOption = None,
    cluster: ClusterOption = None,
    out: OutOption = None,
    parquet: ParquetOption = False,
    dark: DarkOption = False,
    json: JsonOption = False,
) -> None:
    """Fly a plan in this process, thousands of times real time.

    Bit for bit as `skein fly` flies it. Of one flight nothing is kept without --out.

    A campaign flies one plan many times on all cores, keeps a row a flight in runs.csv, and goes on where it was
    stopped when it is started again with the same --out.

    Example: skein rehearse runs/first --delay 0.4

    Example: skein rehearse vee --runs 100 --delay 0.2,0.4 --vary arm=full,own_schedule --out runs/delays
    """
    with exit_codes(), drawn_dark(dark):
        from gcs.cli.progress import working
        from missions.errors import InputError

        with working("Loading planner and simulation", brief=True):
            import gcs.rehearsal  # noqa: F401 (takes seconds)

        axes = wanted_axes(campaign, vary, delay, chosen_arm(no_corrections, no_neighbours))
        if runs is not None or campaign is not None or vary or any(len(values) > 1 for values in axes.values()):
            workers = chosen_workers(jobs, cluster)
            rehearse_often(source, seed, axes, runs or 1, out, workers, parquet=parquet, json=json)
        elif parquet or jobs is not None or cluster is not None:
            raise InputError("--parquet, --jobs, --cluster: are for campaigns; give --runs, --vary or --campaign")
        else:
            rehearse_once(source, seed, axes, out, json)


def wanted_axes(
    file: Path | None, vary: "Sequence[str] | None", delay: str | None, arm: "Arm"
) -> "dict[str, Sequence[Any]]":
    """Values by key, from a campaign's file and from options; an arm only when it is not the usual one.

    Raises:
        InputError: the file cannot be read, an option has no value, or a key is given twice.
    """
    from gcs.campaign.axes import ARM, DELAY, parse_axis, read_axes
    from missions.errors import InputError

    axes = {} if file is None else read_axes(file)
    given = [parse_axis(text) for text in vary or ()]
    if delay is not None:
        given.append(parse_axis(f"{DELAY}={delay}"))
    if arm != "full":
        given.append((ARM, [arm]))
    for key, values in given:
        if key in axes:
            raise InputError(f"{key}: is given twice")
        axes[key] = values
    return axes


def rehearse_often(
    source: str,
    seed: int | None,
    axes: "Mapping[str, Sequence[Any]]",
    runs: int,
    out: Path | None,
    workers: "Workers",
    *,
    parquet: bool,
    json: bool,
) -> None:
    """Fly a campaign."""
    from gcs.campaign.axes import make_axes
    from gcs.campaign.campaign import Campaign
    from gcs.campaign.folder import campaign_folder
    from gcs.cli.campaign import fly_and_summarise
    from gcs.cli.planning import plan_for, read_source

    given = read_source(source)
    checked = make_axes(given.scenario, axes)
    run = campaign_folder(out, given.scenario.name)
    plan = plan_for(run, given, seed)
    first = plan.seed if seed is None else seed
    campaign = Campaign(given.scenario, plan, checked, range(first, first + runs))
    fly_and_summarise(run, campaign, given.text, workers, parquet=parquet, json=json)


def rehearse_once(
    source: str, seed: int | None, values: "Mapping[str, Sequence[Any]]", out: Path | None, json: bool
) -> None:
    """Rehearse, keep truth, metrics and figures if there is a folder for them, print the report; exit with 1 if
    something fell short."""
    import logging

    from gcs.campaign.axes import ARM, DELAY, make_axes
    from gcs.cli.compiling import compile_with_progress
    from gcs.cli.flight_report import show_report, warn_of_delay
    from gcs.cli.planning import plan_for, read_source
    from gcs.cli.progress import working
    from gcs.rehearsal import RehearsalOptions, rehearse_plan
    from gcs.report import keep_report, report_on
    from gcs.run_folder import make_run_folder
    from gcs.truth import write_shifts, write_truths
    from planner.verify import require, verify

    given = read_source(source)
    scenario = given.scenario
    chosen: dict[str, Any] = {key: value for key, (value,) in make_axes(scenario, values).items()}
    run = None if out is None else make_run_folder(out, scenario.name)
    plan = plan_for(run, given, seed)
    options = RehearsalOptions(
        seed=plan.seed if seed is None else seed,
        delay_s=chosen.get(DELAY, scenario.formation.delay_s),
        arm=chosen.get(ARM, "full"),
    )
    warn_of_delay(scenario, options.delay_s, options.arm)
    logging.getLogger(__name__).info("%s: %s", scenario.name, options)
    require(verify(plan, scenario))
    compile_s = compile_with_progress(scenario, plan)
    with working(f"Rehearsing {scenario.name}", brief=True):
        truths, record = rehearse_plan(scenario, plan, options, compile_s)
    with working("Computing figures of merit" + ", drawing" * (run is not None), brief=True):
        report = report_on(scenario, plan, truths, record)
        if run is not None:
            run.write_plan(given.text, scenario, plan)
            run.begin_flight()
            write_truths(truths, run.truth)
            write_shifts(record.shifts, run.truth)
            keep_report(run, scenario, plan, truths, report)
    show_report(report, run, json)
