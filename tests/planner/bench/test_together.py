"""Plans of all vehicles together."""

import math

import pytest

from missions.commands import Command, Frame
from missions.mission import Mission, MissionItem
from missions.scenario import load_scenario
from planner.bench.best_known import BestKnown, load_best_known
from planner.bench.problems import bench_problem
from planner.bench.together import PlanRun, offer_best_paths, offer_plan, plan_digest, plan_figures, total_km
from planner.cost.kernel import INFEASIBLE_KM
from planner.formation_plan import FitnessTerms, FormationPlan, UavPlan

HOME = MissionItem(Command.NAV_WAYPOINT, Frame.GLOBAL)


def test_totals_add_up_until_two_come_too_close() -> None:
    known, scenario = load_best_known(), load_scenario("mountains")
    entries = [known.paths[bench_problem(f"mountains-{vehicle.name}").digest] for vehicle in scenario.vehicles]
    paths = [entry.path_m for entry in entries]
    assert total_km(scenario, paths) == pytest.approx(sum(entry.value_km for entry in entries), rel=1e-9)
    twin = scenario.model_copy(update={"vehicles": (*scenario.vehicles, scenario.vehicles[-1])})
    assert total_km(twin, [*paths, paths[-1]]) > INFEASIBLE_KM


def test_a_plan_is_kept_when_it_is_better() -> None:
    known, scenario = load_best_known(), load_scenario("mountains")
    entries = [known.paths[bench_problem(f"mountains-{vehicle.name}").digest] for vehicle in scenario.vehicles]
    uavs = tuple(
        UavPlan(
            sysid=vehicle.sysid,
            name=vehicle.name,
            waypoints_m=bench_problem(f"mountains-{vehicle.name}").problem.corners_m(entry.path_m),
            terms=FitnessTerms(entry.value_km, 0.0, 0.0, 0.0, 0.0),
            straight_line_m=1.0,
            length_m=1.0,
            evaluations=1,
            history=(),
            mission=Mission((HOME,)),
        )
        for vehicle, entry in zip(scenario.vehicles, entries, strict=True)
    )
    plan, kept = FormationPlan("mountains", 1, "skein", uavs, 0.0, 0.5), BestKnown({}, {})
    assert offer_plan(kept, scenario, plan)
    assert not offer_plan(kept, scenario, plan)
    assert kept.value_km(plan_digest(scenario)) == pytest.approx(sum(entry.value_km for entry in entries))


def test_best_paths_that_keep_their_distance_are_a_plan() -> None:
    known, scenario = load_best_known(), load_scenario("mountains")
    known.plans.clear()
    assert offer_best_paths(known, scenario)
    assert not offer_best_paths(known, scenario)
    twin = scenario.model_copy(update={"vehicles": (*scenario.vehicles, scenario.vehicles[-1])})
    assert not offer_best_paths(known, twin)
    assert not offer_best_paths(BestKnown({}, {}), scenario)


def test_digests_know_the_scenario() -> None:
    scenario = load_scenario("radars")
    wider = scenario.model_copy(update={"limits": scenario.limits.model_copy(update={"separation_m": 300.0})})
    assert len({plan_digest(scenario), plan_digest(wider), plan_digest(load_scenario("mountains"))}) == 3


def test_figures_of_three_runs_by_hand() -> None:
    plan = FormationPlan("radars", 1, "skein", (), 0.0, 0.5)
    runs = [
        PlanRun("radars", "skein", 1, 200.0, 0.5, plan),
        PlanRun("radars", "skein", 2, 200.1, 0.7, plan),
        PlanRun("radars", "skein", 3, math.inf, 0.0, None, "no path"),
    ]
    figures = plan_figures(runs, 200.0)
    assert figures["success_rate"] == {"within_0.01": pytest.approx(2 / 3), "within_0.001": pytest.approx(2 / 3)}
    assert figures["gap"] == {"q1": 0.0, "median": pytest.approx(0.0005), "q3": None}
    assert figures["plan_s"]["median"] == 0.5
    assert figures["seeds"][2] == {"seed": 3, "total_km": None, "plan_s": 0.0, "reason": "no path"}
    assert plan_figures(runs, 150.0)["success_rate"]["within_0.01"] == 0.0
