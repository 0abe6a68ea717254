from gcs.bench.rehearsal_speed import measure_rehearsal
from missions.scenario import Scenario
from planner.formation_plan import FormationPlan


def test_rehearsal_and_endpoints_are_timed_on_the_same_flight(short: Scenario, short_plan: FormationPlan) -> None:
    said: list[str] = []
    speed = measure_rehearsal(short, short_plan, 3, said.append)
    assert speed.same_trajectory
    assert (speed.scenario, speed.vehicles) == ("short", 3)
    assert 0.0 < speed.rehearsal_cpu_s <= speed.rehearsal_median_cpu_s
    assert speed.rehearsal_factor == speed.rehearsal_sim_s / speed.rehearsal_cpu_s
    assert speed.rehearsal_sim_s > 80.0
    assert said[0] == "Compiling, rehearsing"
