"""`skein bench`: compare searches fairly."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from gcs.cli.errors import FELL_SHORT, exit_codes
from gcs.cli.options import DarkOption, JsonOption, finite
from gcs.cli.workers import ClusterOption, JobsOption, chosen_workers
from gcs.theme import drawn_dark

if TYPE_CHECKING:
    from collections.abc import Sequence

    from planner.bench.comparison import Comparison
    from planner.bench.job import Limit
    from planner.bench.problems import BenchProblem
    from planner.jobs.run_jobs import Workers

SEEDS, BUDGET, TIME_S = 15, "200,2000", 1.0
QUICK_SEEDS, QUICK_BUDGET, QUICK_TIME_S = 3, "200", 0.2

ProblemsOption = Annotated[
    str | None,
    typer.Option(
        "--problems", metavar="NAMES", help="Problems such as walls-20-3 or radars-F3, families, paper, quick or all."
    ),
]
MethodsOption = Annotated[str, typer.Option("--methods", metavar="NAMES", help="Searches, with commas, or all.")]
SeedsOption = Annotated[int | None, typer.Option("--seeds", min=1, metavar="N", help="Runs of each; 15 unless given.")]
BudgetOption = Annotated[
    str | None,
    typer.Option(
        "--budget", metavar="N,N", help="Evaluations a dimension; 200,2000 unless given, 0 for no such comparison."
    ),
]
TimeOption = Annotated[
    float | None,
    typer.Option(
        "--time", metavar="S", min=0.0, callback=finite, help="CPU seconds of each run at equal time; 1 unless given."
    ),
]
QuickOption = Annotated[bool, typer.Option("--quick", help="A handful of problems, 3 seeds, small limits.")]
KernelOption = Annotated[bool, typer.Option("--kernel", help="Measure the compiled objective instead of searches.")]
TogetherOption = Annotated[
    bool, typer.Option("--together", help="Plan all vehicles of the paper's scenarios together, seed by seed, instead.")
]
GrowthOption = Annotated[
    bool, typer.Option("--growth", help="Measure how planning time grows up to 100 vehicles, instead.")
]
MavlinkOption = Annotated[
    bool, typer.Option("--mavlink", help="Measure station and endpoints against MAVSDK and MAVProxy, instead.")
]
RehearsalOption = Annotated[
    bool, typer.Option("--rehearsal", help="Measure how fast nine aircraft are rehearsed, and flown, instead.")
]
ChainOption = Annotated[
    bool, typer.Option("--chain", help="Measure how far positions are moved from plan to telemetry, instead.")
]
ConsoleOption = Annotated[
    bool, typer.Option("--console", help="Measure what a console costs that shows 9 and 200 vehicles, instead.")
]
OutOption = Annotated[Path | None, typer.Option("--out", metavar="DIR", help="Folder for bench.json and figures.")]
UpdateOption = Annotated[bool, typer.Option("--update-best", help="Keep what is better than the best-known paths.")]


def bench(
    problems: ProblemsOption = None,
    methods: MethodsOption = "all",
    seeds: SeedsOption = None,
    budget: BudgetOption = None,
    time: TimeOption = None,
    jobs: JobsOption = None,
    cluster: ClusterOption = None,
    quick: QuickOption = False,
    out: OutOption = None,
    update_best: UpdateOption = False,
    together: TogetherOption = False,
    kernel: KernelOption = False,
    growth: GrowthOption = False,
    mavlink: MavlinkOption = False,
    rehearsal: RehearsalOption = False,
    chain: ChainOption = False,
    console: ConsoleOption = False,
    dark: DarkOption = False,
    json: JsonOption = False,
) -> None:
    """Compare searches, stations and speeds with their peers.

    Searches on many problems, at equal evaluations and at equal CPU time, unless an option names something else.

    Example: skein bench --quick --methods pso,skein --out /tmp/bench
    """
    with exit_codes(), drawn_dark(dark):
        if kernel:
            measure_kernel(json)
            return
        if mavlink:
            from gcs.cli.bench_mavlink import measure_mavlink

            measure_mavlink(quick, json)
            return
        if rehearsal:
            from gcs.cli.bench_rehearsal import bench_rehearsal

            bench_rehearsal(quick, json)
            return
        if console:
            from gcs.cli.bench_console import bench_console

            bench_console(quick, json)
            return
        if chain:
            from gcs.cli.bench_chain import bench_chain

            bench_chain(quick, json)
            return
        if growth:
            plan_many(quick, out, json)
            return
        if together:
            plan_together(methods, seeds or (QUICK_SEEDS if quick else SEEDS), update_best, json)
            return
        from gcs.cli.progress import working

        with working("Loading planner", brief=True):
            from gcs.cli import output
            from gcs.cli.bench_tables import family_table, method_table
            from planner.bench.best_known import load_best_known
            from planner.bench.compare import offer_runs
            from planner.bench.methods import method_names
            from planner.bench.problems import bench_problem, problem_names

        limits = chosen_limits(
            budget if budget is not None else QUICK_BUDGET if quick else BUDGET,
            time if time is not None else QUICK_TIME_S if quick else TIME_S,
        )
        names = problem_names(problems if problems is not None else "quick" if quick else "all")
        searches = method_names(methods)
        workers = chosen_workers(jobs, cluster)
        if out is not None:
            out.mkdir(parents=True, exist_ok=True)
        comparison = with_progress(
            [bench_problem(name) for name in names],
            searches,
            seeds or (QUICK_SEEDS if quick else SEEDS),
            limits,
            workers,
        )
        if json:
            output.print_json_line(comparison.as_json())
        else:
            for limit in comparison.limits:
                output.print_wide(method_table(comparison, limit))
                output.print_wide(family_table(comparison, limit))
        if out is not None:
            write(comparison, out)
        if update_best:
            known = load_best_known()
            better = offer_runs(known, comparison)
            known.save()
            output.progress.print(f"Better than before: {', '.join(better) or 'none'}")
        for failure in comparison.failures:
            output.progress.print(f"No result: {failure.job.name}: {failure.reason}", markup=False)
        if comparison.failures:
            raise SystemExit(FELL_SHORT)


def measure_kernel(json: bool) -> None:
    """How fast the compiled objective is."""
    from dataclasses import asdict

    from gcs.cli import output
    from gcs.cli.bench_tables import kernel_table, work_table
    from gcs.cli.progress import working
    from planner.bench.kernel_speed import kernel_speeds

    with working("Measuring the compiled objective"):
        peaks, speeds = kernel_speeds()
    if json:
        output.print_json({"peaks_per_s": peaks, "kernel": [asdict(speed) for speed in speeds]})
    else:
        output.print_wide(kernel_table(speeds))
        output.print_wide(work_table(peaks, speeds))


def plan_many(quick: bool, out: Path | None, json: bool) -> None:
    """Plan fields of more and more vehicles."""
    from dataclasses import asdict

    from gcs.cli import output
    from gcs.cli.bench_tables import growth_table
    from gcs.cli.progress import working
    from gcs.figures.growth import draw_growth
    from planner.bench.growth import NUMBERS, exponent, measure_growth

    numbers = NUMBERS[:2] if quick else NUMBERS
    with working("Planning fields of vehicles", count=len(numbers)) as bar:
        growths = measure_growth(numbers, bar.advance)
    if json:
        output.print_json({"growth": [asdict(growth) for growth in growths], "exponent": exponent(growths)})
    else:
        output.print_wide(growth_table(growths, exponent(growths)))
    if out is not None:
        out.mkdir(parents=True, exist_ok=True)
        draw_growth(growths, out / "growth.png")


def plan_together(methods: str, seeds: int, update_best: bool, json: bool) -> None:
    """Plan all vehicles of the paper's scenarios with each of some methods, `skein` unless named."""
    from gcs.cli import output
    from gcs.cli.bench_tables import together_table
    from gcs.cli.progress import working
    from missions.errors import InputError
    from missions.scenario import load_scenario
    from planner.bench.best_known import load_best_known
    from planner.bench.problems import SCENARIOS
    from planner.bench.together import offer_best_paths, offer_plan, plan_digest, plan_figures, plan_run
    from planner.find_path import METHODS, SKEIN

    chosen = [SKEIN] if methods == "all" else methods.split(",")
    for method in chosen:
        if method not in METHODS:
            raise InputError(f"method {method}: plans are made by {', '.join(METHODS)}")
    known, figures, better = load_best_known(), [], []
    with working("Planning", count=len(SCENARIOS) * len(chosen) * seeds) as bar:
        for name in SCENARIOS:
            scenario = load_scenario(name)
            if offer_best_paths(known, scenario):
                better.append(name)
            best_km = known.value_km(plan_digest(scenario))
            for method in chosen:
                runs = []
                for seed in range(1, seeds + 1):
                    runs.append(plan_run(scenario, method, seed))
                    bar.advance(f"Planning {name}, {method}")
                figures.append(plan_figures(runs, best_km))
                better += [name for run in runs if run.plan and offer_plan(known, scenario, run.plan)]
    if json:
        output.print_json(figures)
    else:
        output.print_wide(together_table(figures))
    if update_best:
        known.save()
        output.progress.print(f"Better than before: {', '.join(dict.fromkeys(better)) or 'none'}")


def chosen_limits(budget: str, time_s: float) -> "tuple[Limit, ...]":
    """Limits of evaluations, then of time. Raises InputError."""
    from missions.errors import InputError
    from planner.bench.job import Limit

    counts = [word.strip() for word in budget.split(",")]
    for word in counts:
        if not word.isdecimal() or int(word) > 10**9:
            raise InputError(f"--budget {budget}: whole numbers with commas, got {word or 'nothing'}")
    limits = [Limit(evaluations_per_dimension=int(word)) for word in dict.fromkeys(counts) if int(word)]
    if time_s:
        limits.append(Limit(cpu_s=time_s))
    if not limits:
        raise InputError("--budget 0 and --time 0: nothing is left to compare at")
    return tuple(limits)


def with_progress(
    problems: "Sequence[BenchProblem]",
    methods: "Sequence[str]",
    seeds: int,
    limits: "Sequence[Limit]",
    workers: "Workers",
) -> "Comparison":
    """Run everything with a progress bar on standard error."""
    from gcs.cli.progress import working
    from planner.bench.best_known import load_best_known
    from planner.bench.compare import compare
    from planner.bench.job import Job, Run
    from planner.jobs.run_jobs import Failure

    with working("Searching", count=len(problems) * len(methods) * seeds * len(limits)) as bar:

        def done(result: Run | Failure[Job]) -> None:
            bar.advance(result.job.name)

        return compare(problems, methods, seeds, limits, workers, load_best_known(), done)


def write(comparison: "Comparison", folder: Path) -> None:
    """Write bench.json and the figures into an existing folder. Raises OSError."""
    import json

    from gcs.cli import output
    from gcs.figures.bench import draw_bench

    text = json.dumps(comparison.as_json(), allow_nan=False)
    (folder / "bench.json").write_text(text + "\n", encoding="utf-8")
    for file in (folder / "bench.json", *draw_bench(comparison, folder)):
        output.progress.print(str(file), soft_wrap=True)
