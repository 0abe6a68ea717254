"""How the formation error of a flight grows with the delay of its corrections: the same flight, rehearsed."""

from collections.abc import Callable
from typing import NamedTuple

from gcs.report_page.flown_run import FlownRun
from gcs.study.delay_trials import delays_s, with_graph
from gcs.study.fly import fly_trials
from gcs.study.trial import Trial, trial_of
from planner.jobs.run_jobs import Workers

SHARES = (0.1, 0.3, 0.5, 0.7, 0.85, 0.95, 1.05, 1.2, 1.4)
"""Of the delay margin."""


class DelayPoint(NamedTuple):
    """Formation error, RMS, at a delay; None when nobody is left to measure."""

    delay_s: float
    rms_error_m: float | None


def delay_trials_of(run: FlownRun) -> list[Trial]:
    """What is to be rehearsed: delays around the margin, and that of the flight; nothing without a margin."""
    margin_s = run.metrics.formation.delay_margin_s
    if margin_s is None or len(run.plan.uavs) < 2 or run.metrics.arm != "full":
        return []
    swept = sorted({*delays_s(margin_s, SHARES), round(run.metrics.delay_s, 6)})
    graph = run.scenario.formation.graph
    return [
        trial_of(with_graph(run.scenario, graph, delay_s), ("full",), delay_s, run.metrics.seed) for delay_s in swept
    ]


def delay_curve(run: FlownRun, trials: list[Trial], workers: Workers, told: Callable[[], None]) -> list[DelayPoint]:
    """Rehearse them, telling of each as it ends. Raises RuntimeError when one gives no result."""
    results = fly_trials(run.scenario, run.plan, trials, workers, lambda _: told())
    return [DelayPoint(trial.level, outcome.rms_error_m) for trial, outcome in results]
