"""What the corrections are worth, seed by seed: the same plan flown with more and less of the formation law."""

from collections.abc import Iterable
from dataclasses import asdict, dataclass, replace
from typing import Any, get_args

import numpy as np

from gcs.study.fly import Results
from gcs.study.trial import Outcome, Trial, trial_of
from missions.scenario import Scenario
from sitl.config import Arm

MOST_OF_PLAIN = 0.15
"""Formation error with neighbours is at most this share of a plain autopilot's, in every seed,"""
MOST_OF_OWN = 0.4
"""and at most this share of what own schedules alone leave, in the median of the seeds."""


@dataclass(frozen=True)
class Worth:
    """Three arms over the same seeds.

    Attributes:
        scenario, gusts, seeds: what was flown.
        median_error_m, worst_error_m: RMS formation error by arm.
        worst_of_plain: largest share, over the seeds, of a plain autopilot's error that is left in full.
        median_of_plain, median_of_own, worst_of_own: likewise.
        seeds_above_plain: in how many seeds it is more than MOST_OF_PLAIN.
        least_separation_m: of two vehicles on their way, by arm, over all seeds.
        seeds_below_safe: in how many seeds it is below limits.separation_m, by arm.
        all_arrived: whether every vehicle did, in every flight.
    """

    scenario: str
    gusts: str
    seeds: int
    median_error_m: dict[str, float]
    worst_error_m: dict[str, float]
    worst_of_plain: float
    median_of_plain: float
    median_of_own: float
    worst_of_own: float
    seeds_above_plain: int
    least_separation_m: dict[str, float]
    seeds_below_safe: dict[str, int]
    all_arrived: bool

    @property
    def beats_plain(self) -> bool:
        """Whether, in every seed, little is left of a plain autopilot's error, all keep their distance and arrive."""
        return self.worst_of_plain <= MOST_OF_PLAIN and self.seeds_below_safe["full"] == 0 and self.all_arrived

    @property
    def beats_own(self) -> bool:
        """Whether neighbours are worth what they should be. It takes paths that lead nearly one way: equal deviations
        along others are errors between them."""
        return self.median_of_own <= MOST_OF_OWN

    def as_json(self) -> dict[str, Any]:
        """As JSON values."""
        return {**asdict(self), "beats_plain": self.beats_plain, "beats_own": self.beats_own}


def arm_trials(scenario: Scenario, gusts: str, seeds: Iterable[int]) -> list[Trial]:
    """All arms with all seeds."""
    return [replace(trial_of(scenario, (arm,), 0.0, seed, arm), gusts=gusts) for seed in seeds for arm in get_args(Arm)]


def worth(scenario: Scenario, results: Results) -> Worth:
    """What flights of `arm_trials` came to."""
    by_arm: dict[str, list[Outcome]] = {
        arm: [outcome for trial, outcome in results if trial.arm == arm] for arm in get_args(Arm)
    }
    errors = {arm: np.array([outcome.rms_error_m for outcome in found]) for arm, found in by_arm.items()}
    separations = {arm: np.array([outcome.separation_m for outcome in found]) for arm, found in by_arm.items()}
    of_plain, of_own = errors["full"] / errors["plain"], errors["full"] / errors["own_schedule"]
    safe_m = scenario.limits.separation_m
    return Worth(
        scenario=scenario.name,
        gusts=results[0][0].gusts,
        seeds=len(of_plain),
        median_error_m={arm: float(np.median(found)) for arm, found in errors.items()},
        worst_error_m={arm: float(found.max()) for arm, found in errors.items()},
        worst_of_plain=float(of_plain.max()),
        median_of_plain=float(np.median(of_plain)),
        median_of_own=float(np.median(of_own)),
        worst_of_own=float(of_own.max()),
        seeds_above_plain=int((of_plain > MOST_OF_PLAIN).sum()),
        least_separation_m={arm: float(found.min()) for arm, found in separations.items()},
        seeds_below_safe={arm: int((found < safe_m).sum()) for arm, found in separations.items()},
        all_arrived=all(outcome.arrived == outcome.survivors for _, outcome in results),
    )
