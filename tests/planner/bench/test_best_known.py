"""The file of best-known paths: every figure can be recomputed by anyone."""

from pathlib import Path

import numpy as np
import pytest

from missions.errors import InputError
from missions.scenario import load_scenario
from planner.bench.best_known import PACKAGED, BestKnown, best_known, load_best_known
from planner.bench.problems import bench_problem, suite
from planner.bench.together import plan_digest, total_km
from planner.cost.kernel import INFEASIBLE_KM, evaluate


def test_every_problem_of_the_suite_has_a_best_known_path_that_costs_what_it_says() -> None:
    known = load_best_known()
    for name in suite():
        problem = bench_problem(name)
        entry = known.paths[problem.digest]
        assert (entry.problem, entry.waypoints) == (name, problem.waypoints)
        cost = evaluate(np.array([entry.path_m]), problem.problem, "graded")[0][0]
        assert cost < INFEASIBLE_KM
        assert cost == pytest.approx(entry.value_km, rel=1e-9)
        assert best_known(problem.digest) == entry.value_km


def test_best_known_plans_cost_what_they_say() -> None:
    for entry in load_best_known().plans.values():
        scenario = load_scenario(entry.scenario)
        assert plan_digest(scenario) == entry.digest
        assert total_km(scenario, entry.paths_m) == pytest.approx(entry.value_km, rel=1e-9)


def test_better_is_kept_worse_is_not_and_broken_never() -> None:
    problem = bench_problem("forest-5-1")
    assert problem.route_m is not None
    route = problem.route_m[1:-1].ravel()
    line = np.linspace(problem.problem.origin_m, problem.problem.target_m, 7)[1:-1].ravel()
    known = BestKnown({}, {})

    def offer(path: np.ndarray) -> bool:
        return known.offer(problem, path, method="pso", evaluations=10, seed=1)

    assert not offer(line)
    assert known.value_km(problem.digest) is None
    assert offer(route)
    first = known.value_km(problem.digest)
    assert first is not None
    assert not offer(route)
    higher = route.copy()
    higher[2::3] += 1.0
    assert offer(higher) == (evaluate(higher[None], problem.problem, "graded")[0][0] < first)


def test_a_file_reads_back_as_written(tmp_path: Path) -> None:
    known = load_best_known()
    known.save(tmp_path / "best.json")
    assert (tmp_path / "best.json").read_text() == PACKAGED.read_text()
    assert load_best_known(tmp_path / "best.json") == known


def test_an_unknown_digest_has_none() -> None:
    assert best_known("0" * 16) is None


@pytest.mark.parametrize("text", ["{", '{"format": 1}', '{"format": 99, "paths": [], "plans": []}'])
def test_another_file_is_refused(tmp_path: Path, text: str) -> None:
    (tmp_path / "best.json").write_text(text)
    with pytest.raises(InputError, match=r"best[.]json: "):
        load_best_known(tmp_path / "best.json")
