"""A seeded tenth of the fault campaign of `make soak`: nobody collides, and every survivor arrives."""

from dataclasses import replace

from gcs.campaign.axes import with_values
from gcs.study.fault_campaign import COLLISION_M, fly_faults, judged
from gcs.study.faults import draw_faults
from gcs.study.trial import Outcome, trial_of
from missions.scenario import Scenario, load_scenario
from planner.formation_plan import FormationPlan
from planner.jobs.run_jobs import Workers
from planner.plan import plan

TENTH = 20


def test_whatever_fails_nobody_collides_and_every_survivor_arrives(
    vee: Scenario, vee_plan: FormationPlan, here: Workers
) -> None:
    campaign = fly_faults(vee, vee_plan, range(1, TENTH + 1), here)
    assert campaign.flights == TENTH
    assert campaign.passed, campaign.failing


def test_in_unforeseen_wind_those_that_give_way_stay_apart_where_others_would_not(here: Workers) -> None:
    """Schedules in which someone hangs before the ways cross, of 300 that were looked through; and some others."""
    crossing = with_values(load_scenario("crossing"), {"wind.steady_m_s": (-5.0, 3.0)})
    seeds, planned = [1, 2, 3, 148, 205, 298], plan(crossing)
    plain, giving_way = (
        fly_faults(with_values(crossing, {"formation.avoidance": on}), planned, seeds, here) for on in (False, True)
    )
    assert plain.below_safe == 3
    assert giving_way.below_safe == 0
    assert giving_way.passed, giving_way.failing


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
