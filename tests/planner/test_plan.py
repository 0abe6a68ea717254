"""Plans of whole scenarios: verified, the same twice, and refused with a reason when there is none."""

from contextlib import suppress
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from missions.errors import InputError
from missions.scenario import Scenario, load_scenario, shipped_scenarios
from planner.formation_plan import FormationPlan, load_plan
from planner.plan import PlanProgress, plan
from planner.verify import require, verify


def smaller(scenario: Scenario, vehicles: int, iterations: int, population: int = 60) -> Scenario:
    """The same scenario with fewer vehicles and less search."""
    search = scenario.search.model_copy(update={"iterations": iterations, "population": population})
    return scenario.model_copy(update={"vehicles": scenario.vehicles[:vehicles], "search": search})


RADARS = smaller(load_scenario("radars"), 3, 40)


def same(first: FormationPlan, second: FormationPlan) -> bool:
    """Whether two plans are equal in all but how long they took."""
    plain, other = (replace(p, compile_s=0.0, plan_s=0.0).as_json() for p in (first, second))
    return plain == other


@pytest.fixture(scope="module")
def three() -> FormationPlan:
    return plan(RADARS)


@pytest.mark.parametrize("name", shipped_scenarios())
def test_shipped_scenarios_give_verified_plans_no_better_than_the_straight_line(name: str) -> None:
    scenario = load_scenario(name)
    result = plan(scenario)
    assert verify(result, scenario).violations == ()
    assert [uav.sysid for uav in result.uavs] == [vehicle.sysid for vehicle in scenario.vehicles]
    arrivals = [reference.duration_s for reference in result.references(scenario).values()]
    assert np.ptp(arrivals) < 0.01
    for uav in result.uavs:
        assert uav.terms.fitness * 1000 >= uav.terms.length * 1000 >= uav.straight_line_m - 1e-6
        assert uav.length_m == pytest.approx(uav.terms.length * 1000, rel=0.01)
        assert uav.terms.collision == 0.0
        assert uav.evaluations <= scenario.search.population * scenario.search.iterations * 3
    assert result.plan_s > 0.0


def test_the_same_seed_gives_the_same_plan_and_another_does_not(three: FormationPlan) -> None:
    assert same(plan(RADARS), three)
    assert not same(plan(RADARS, seed=2), three)


def test_what_the_leader_flies_does_not_depend_on_who_follows(three: FormationPlan) -> None:
    two = plan(smaller(RADARS, 2, 40))
    for early, late in zip(two.uavs, three.uavs[:2], strict=True):
        assert np.array_equal(early.waypoints_m, late.waypoints_m)


def test_methods_differ_and_keep_to_the_same_budget(three: FormationPlan) -> None:
    by_pso = plan(RADARS, method="pso")
    assert (three.method, by_pso.method) == ("skein", "pso")
    budget = 3 * RADARS.search.population * RADARS.search.iterations
    for uav, other in zip(three.uavs, by_pso.uavs, strict=True):
        assert not np.array_equal(uav.waypoints_m, other.waypoints_m)
        assert max(uav.evaluations, other.evaluations) <= budget
        assert uav.terms.fitness < other.terms.fitness


def test_history_ends_at_the_cost_of_the_path(three: FormationPlan) -> None:
    for uav in three.uavs:
        assert uav.history[-1] == (uav.evaluations, pytest.approx(uav.terms.fitness, rel=1e-12))
        known = [cost for _, cost in uav.history if cost is not None]
        assert known == sorted(known, reverse=True)


@pytest.mark.parametrize("method", ["skein", "hybrid"])
def test_progress_tells_of_every_uav_until_its_end(method: str) -> None:
    told: list[PlanProgress] = []
    scenario = smaller(RADARS, 2, 5)
    with suppress(InputError):  # five iterations need not find a path
        plan(scenario, method=method, progress=told.append)
    for uav in (0, 1):
        mine = [now for now in told if now.uav == uav]
        assert mine[-1].part == 1.0
        assert all(0.0 < now.part <= 1.0 for now in mine)
        assert all(now.uavs == 2 and now.name == scenario.vehicles[uav].name for now in mine)


def test_a_progress_that_raises_stops_planning() -> None:
    def stop(_: PlanProgress) -> None:
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        plan(RADARS, progress=stop)


def test_a_plan_survives_its_file(three: FormationPlan, tmp_path: Path) -> None:
    three.save(tmp_path / "plan.json")
    again = load_plan(tmp_path / "plan.json")
    assert again.as_json() == three.as_json()
    assert all(a.mission == b.mission for a, b in zip(again.uavs, three.uavs, strict=True))
    assert all(np.array_equal(a.waypoints_m, b.waypoints_m) for a, b in zip(again.uavs, three.uavs, strict=True))
    require(verify(again, RADARS))


def test_a_target_behind_a_wall_says_so() -> None:
    across = {"radius_m": 16000.0, "x_m": 16500.0, "y_m": 16000.0, "height_m": 9000.0}
    wall = RADARS.obstacles[0].model_copy(update=across)
    scenario = smaller(RADARS, 1, 3).model_copy(update={"obstacles": (wall,)})
    scenario.__dict__.pop("environment", None)
    with pytest.raises(InputError, match=r"leader: no path found in \d+ evaluations: the best .*obstacles\[0\] on leg"):
        plan(scenario)


def test_a_slot_plan_that_fails_verification_is_never_returned() -> None:
    vee = load_scenario("vee")
    strict = vee.model_copy(update={"limits": vee.limits.model_copy(update={"separation_m": 130.0})})
    with pytest.raises(InputError, match=r"vee: route.points.*: \w+: 1[12]\d m from \w+"):
        plan(strict)


def test_an_unknown_method_is_refused_by_name() -> None:
    with pytest.raises(InputError, match="method annealing: must be one of skein, pso, qpso, hybrid, published"):
        plan(RADARS, method="annealing")


def test_a_negative_seed_is_refused() -> None:
    with pytest.raises(InputError, match="seed -1: must be 0 or more"):
        plan(RADARS, seed=-1)
