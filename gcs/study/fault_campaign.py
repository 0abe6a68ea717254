"""Many flights with random failures: does anyone collide, and does every survivor arrive?"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any

from gcs.study.faults import Faults, draw_faults
from gcs.study.fly import Results, fly_trials
from gcs.study.trial import Outcome, Trial, trial_of
from missions.scenario import Scenario
from planner.formation_plan import FormationPlan
from planner.jobs.run_jobs import Workers

COLLISION_M = 10.0
"""Centres as near as this count as a collision: some three spans of the shipped airframe."""


@dataclass(frozen=True)
class FaultCampaign:
    """What came of a scenario's flights.

    Attributes:
        scenario, flights: what was flown, and how often.
        collisions: flights in which two came nearer than COLLISION_M, at any time.
        below_safe: flights in which two on their way came nearer than limits.separation_m.
        stranded: flights in which a survivor did not arrive.
        least_separation_m: of two on their way, over all flights.
        nearest_m: of any two, those that circle at their targets included.
        latest_s: the last arrival of all.
        failing: what fell short, with the schedule, flight by flight.
    """

    scenario: str
    flights: int
    collisions: int
    below_safe: int
    stranded: int
    least_separation_m: float
    nearest_m: float
    latest_s: float
    failing: list[dict[str, Any]]

    @property
    def passed(self) -> bool:
        """Nobody has collided, and every survivor has arrived."""
        return self.collisions == self.stranded == 0


def fly_faults(
    scenario: Scenario,
    plan: FormationPlan,
    seeds: Sequence[int],
    workers: Workers,
    told: Callable[[Trial], None] = lambda trial: None,
) -> FaultCampaign:
    """Fly a schedule for each seed, which is that of the gusts as well.

    Raises:
        RuntimeError: a flight gave no result.
    """
    sysids = [uav.sysid for uav in plan.uavs]
    duration_s = max(reference.duration_s for reference in plan.references(scenario).values())
    drawn = {seed: draw_faults(seed, sysids, duration_s) for seed in seeds}
    trials = [
        replace(trial_of(scenario, ("faults",), 0.0, seed), channel=faults.channel, failures=faults.failures)
        for seed, faults in drawn.items()
    ]
    return judged(scenario, drawn, fly_trials(scenario, plan, trials, workers, told))


def judged(scenario: Scenario, drawn: dict[int, Faults], results: Results) -> FaultCampaign:
    """What flights of schedules, by seed, came to."""
    safe_m = scenario.limits.separation_m
    collided = [trial.seed for trial, outcome in results if _nearer(outcome.nearest_m, COLLISION_M)]
    below = [trial.seed for trial, outcome in results if _nearer(outcome.separation_m, safe_m)]
    stranded = [trial.seed for trial, outcome in results if outcome.arrived < outcome.survivors]
    outcomes = [outcome for _, outcome in results]
    return FaultCampaign(
        scenario=scenario.name,
        flights=len(results),
        collisions=len(collided),
        below_safe=len(below),
        stranded=len(stranded),
        least_separation_m=_least(outcomes, "separation_m"),
        nearest_m=_least(outcomes, "nearest_m"),
        latest_s=max(outcome.last_s for outcome in outcomes if outcome.last_s is not None),
        failing=[
            {
                "collision": trial.seed in collided,
                "below_safe": trial.seed in below,
                "stranded": outcome.survivors - outcome.arrived,
                "separation_m": outcome.separation_m,
                "nearest_m": outcome.nearest_m,
                **drawn[trial.seed].as_json(),
            }
            for trial, outcome in results
            if trial.seed in {*collided, *below, *stranded}
        ],
    )


def _nearer(distance_m: float | None, than_m: float) -> bool:
    return distance_m is not None and distance_m < than_m


def _least(outcomes: Sequence[Outcome], key: str) -> float:
    return float(min(value for outcome in outcomes if (value := getattr(outcome, key)) is not None))
