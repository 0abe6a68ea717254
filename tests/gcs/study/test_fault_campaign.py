"""A seeded tenth of the fault campaign of `make soak`: nobody collides, and every survivor arrives."""

from dataclasses import replace

from gcs.study.fault_campaign import COLLISION_M, fly_faults, judged
from gcs.study.faults import draw_faults
from gcs.study.trial import Outcome, trial_of
from missions.scenario import Scenario
from planner.formation_plan import FormationPlan
from planner.jobs.run_jobs import Workers

TENTH = 20


def test_whatever_fails_nobody_collides_and_every_survivor_arrives(
    vee: Scenario, vee_plan: FormationPlan, here: Workers
) -> None:
    campaign = fly_faults(vee, vee_plan, range(1, TENTH + 1), here)
    assert campaign.flights == TENTH
    assert campaign.passed, campaign.failing


def test_what_falls_short_is_told_with_its_schedule(vee: Scenario) -> None:
    good = Outcome(1.0, 0.1, 0.0, 1.0, 100.0, 40.0, 9, 9, 430.0)
    outcomes = {
        1: good,
        2: replace(good, nearest_m=0.9 * COLLISION_M),
        3: replace(good, separation_m=0.9 * vee.limits.separation_m),
        4: replace(good, arrived=8),
    }
    drawn = {seed: draw_faults(seed, range(1, 10), 430.0) for seed in outcomes}
    results = [(trial_of(vee, ("faults",), 0.0, seed), outcome) for seed, outcome in outcomes.items()]
    campaign = judged(vee, drawn, results)
    assert (campaign.collisions, campaign.below_safe, campaign.stranded) == (1, 1, 1)
    assert not campaign.passed
    assert [failing["seed"] for failing in campaign.failing] == [2, 3, 4]
    assert campaign.failing[0]["failures"] == drawn[2].as_json()["failures"]
