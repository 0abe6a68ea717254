"""Corrections are worth what the model says, on a few of the thousand seeds that `make soak` flies."""

from gcs.study.arms import arm_trials, worth
from gcs.study.fly import fly_trials
from missions.scenario import Scenario
from planner.formation_plan import FormationPlan
from planner.jobs.run_jobs import Workers


def test_in_moderate_gusts_neighbours_leave_a_fraction_of_the_error(
    vee: Scenario, vee_plan: FormationPlan, here: Workers
) -> None:
    found = worth(vee, fly_trials(vee, vee_plan, arm_trials(vee, "moderate", range(1, 4)), here))
    assert found.seeds == 3
    assert found.worst_of_plain < 0.15
    assert found.median_of_own < 0.6
    assert found.seeds_below_safe["full"] == 0
    assert found.all_arrived
