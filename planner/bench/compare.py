"""A whole comparison: every method on every problem with every seed under every limit."""

from collections.abc import Callable, Sequence

from planner.bench.best_known import BestKnown
from planner.bench.comparison import Comparison
from planner.bench.job import Job, Limit, Run, run_job
from planner.bench.problems import BenchProblem
from planner.jobs.run_jobs import Failure, Workers, run_jobs


def make_jobs(
    problems: Sequence[BenchProblem], methods: Sequence[str], seeds: int, limits: Sequence[Limit]
) -> list[Job]:
    """All jobs, with seeds 1 to `seeds`: the longest first, so that no process is left with one in the end."""
    return [
        Job(problem.name, problem.digest, method, seed, limit)
        for limit in sorted(limits, key=lambda limit: limit.evaluations_per_dimension, reverse=True)
        for problem in sorted(problems, key=lambda problem: problem.dimension, reverse=True)
        for method in methods
        for seed in range(1, seeds + 1)
    ]


def compare(
    problems: Sequence[BenchProblem],
    methods: Sequence[str],
    seeds: int,
    limits: Sequence[Limit],
    workers: Workers,
    known: BestKnown,
    done: Callable[[Run | Failure[Job]], None],
) -> Comparison:
    """Run everything, telling of each run as it ends."""
    results: list[Run | Failure[Job]] = []

    def keep(result: Run | Failure[Job]) -> None:
        results.append(result)
        done(result)

    jobs = make_jobs(problems, methods, seeds, limits)
    run_jobs(jobs, workers, run_job, keep)
    order = {job: i for i, job in enumerate(jobs)}
    results.sort(key=lambda result: order[result.job])
    return Comparison(
        problems=tuple(problems),
        methods=tuple(methods),
        limits=tuple(limits),
        known_km={problem.name: value for problem in problems if (value := known.value_km(problem.digest)) is not None},
        runs=tuple(result for result in results if isinstance(result, Run)),
        failures=tuple(result for result in results if isinstance(result, Failure)),
    )


def offer_runs(known: BestKnown, comparison: Comparison) -> list[str]:
    """Keep all paths that are better than what is known; names of the problems whose best-known value fell."""
    problems = {problem.name: problem for problem in comparison.problems}
    better: dict[str, None] = {}
    for run in comparison.runs:
        if run.path_m is not None and known.offer(
            problems[run.job.problem],
            run.path_m,
            method=run.job.method,
            evaluations=run.evaluations,
            seed=run.job.seed,
        ):
            better[run.job.problem] = None
    return list(better)
