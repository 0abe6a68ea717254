"""Many trials on this machine's cores."""

import pickle
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from functools import lru_cache

from gcs.metrics import Planned, what_was_planned
from gcs.study.trial import Outcome, Trial, fly_trial
from missions.scenario import Scenario
from planner.formation_plan import FormationPlan
from planner.jobs.run_jobs import Failure, Workers, run_jobs

Results = list[tuple[Trial, Outcome]]


@dataclass(frozen=True)
class Flights:
    """Flies trials of one plan; `data` is scenario and plan, pickled."""

    data: bytes

    def fly(self, trial: Trial) -> tuple[Trial, Outcome]:
        """Fly one."""
        scenario, plan, planned = _opened(self.data)
        return trial, fly_trial(scenario, plan, planned, trial)


def fly_trials(
    scenario: Scenario,
    plan: FormationPlan,
    trials: Iterable[Trial],
    workers: Workers,
    told: Callable[[Trial], None] = lambda trial: None,
) -> Results:
    """Fly trials, telling of each as it ends; the results are in the trials' order.

    Raises:
        RuntimeError: one gave no result.
    """
    ordered = list(trials)
    found: dict[Trial, Outcome] = {}

    def done(result: tuple[Trial, Outcome] | Failure[Trial]) -> None:
        if isinstance(result, Failure):
            raise RuntimeError(
                f"{', '.join(result.job.curve)}, {result.job.level:g}, seed {result.job.seed}: {result.reason}"
            )
        found[result[0]] = result[1]
        told(result[0])

    run_jobs(ordered, workers, Flights(pickle.dumps((scenario, plan))).fly, done)
    return [(trial, found[trial]) for trial in ordered]


@lru_cache(maxsize=1)
def _opened(data: bytes) -> tuple[Scenario, FormationPlan, Planned]:
    scenario, plan = pickle.loads(data)
    return scenario, plan, what_was_planned(scenario, plan)
