"""`skein study`: what the formation law does, over many flights."""

from pathlib import Path
from typing import Annotated

import typer

from gcs.cli.completion import sources
from gcs.cli.errors import exit_codes
from gcs.cli.options import DarkOption, JsonOption
from gcs.cli.verbosity import Commands
from gcs.cli.workers import ClusterOption, JobsOption, chosen_workers
from gcs.theme import drawn_dark

SEEDS, QUICK_SEEDS = 20, 3

study = Commands(name="study", help="Study the formation law over many flights.", no_args_is_help=True)

SourceArgument = Annotated[
    str,
    typer.Argument(
        metavar="[SCENARIO|FILE|RUN]",
        help="A scenario that ships, a TOML file, or a planned run.",
        autocompletion=sources,
    ),
]
SeedsOption = Annotated[
    int | None, typer.Option("--seeds", min=2, metavar="N", help=f"Flights a point; {SEEDS} unless given.")
]
EdgesOption = Annotated[
    str | None,
    typer.Option("--edges", metavar="P-Q,P-Q", help="The custom graph; the arms of a V, or the scenario's own edges."),
]
QuickOption = Annotated[bool, typer.Option("--quick", help=f"Fewer delays, {QUICK_SEEDS} seeds.")]
OutOption = Annotated[
    Path | None, typer.Option("--out", metavar="DIR", help="Folder for tables and pictures; one in runs/ if not given.")
]


@study.command("delay")
def delay(
    source: SourceArgument = "vee",
    seeds: SeedsOption = None,
    edges: EdgesOption = None,
    quick: QuickOption = False,
    out: OutOption = None,
    jobs: JobsOption = None,
    cluster: ClusterOption = None,
    dark: DarkOption = False,
    json: JsonOption = False,
) -> None:
    """Sweep the delay across the margin on several graphs: the linear law, and aircraft in all three arms. Then jitter,
    loss and bursts at the scenario's delay; all vehicles pinned to their schedules against one; and what travels along
    a line.

    Example: skein study delay vee --quick --out runs/delay
    """
    with exit_codes(), drawn_dark(dark):
        from gcs.cli.progress import working

        with working("Loading planner and simulation", brief=True):
            from gcs.cli import output
            from gcs.cli.compiling import compile_with_progress
            from gcs.cli.planning import plan_for, read_source
            from gcs.cli.study_table import delay_table
            from gcs.run_folder import make_run_folder
            from gcs.study.delay import study_delay, trials_of
            from gcs.study.delay_trials import QUICK_SHARES, SHARES
            from gcs.study.graphs import parse_edges, studied_graphs
            from gcs.study.trial import Trial
            from planner.verify import require, verify

        given = read_source(source)
        scenario = given.scenario
        graphs = studied_graphs(scenario, None if edges is None else parse_edges(edges))
        workers = chosen_workers(jobs, cluster)
        run = make_run_folder(out, f"study-{scenario.name}")
        plan = plan_for(run, given, None)
        require(verify(plan, scenario))
        first = scenario.seed
        flown = range(first, first + (seeds or (QUICK_SEEDS if quick else SEEDS)))
        trials = trials_of(scenario, graphs, QUICK_SHARES if quick else SHARES, flown)
        compile_with_progress(scenario, plan)
        with working(f"Rehearsing {scenario.name}", count=sum(map(len, trials.values()))) as bar:

            def told(trial: Trial) -> None:
                bar.advance()

            found = study_delay(scenario, plan, graphs, trials, workers, told)
        with working("Drawing"):
            files = found.write(run.path)
        if json:
            output.print_json({"study": str(run.path), **found.as_json()})
        else:
            output.out.print(delay_table(found))
            for file in files:
                output.out.print(str(file), soft_wrap=True)
