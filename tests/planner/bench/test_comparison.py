"""What the runs of a comparison say, against a case small enough to work by hand."""

import json
import math
from collections.abc import Callable

import pytest

from planner.bench.comparison import Comparison
from planner.bench.job import Limit, Run
from planner.bench.problems import bench_problem

LIMIT = Limit(100)
PROBLEMS = tuple(bench_problem(name) for name in ("forest-5-1", "radars-F2"))


@pytest.fixture
def comparison(make_run: Callable[..., Run]) -> Comparison:
    """Two problems, best-known 10 and none; "skein" near at once, "pso" slowly, "de" on the first problem only."""
    lines = {
        ("forest-5-1", "skein"): [(10, 0.1, 10.005)],
        ("forest-5-1", "pso"): [(100, 1.0, 10.5), (500, 5.0, 10.05)],
        ("forest-5-1", "de"): [(400, 4.0, 11.0)],
        ("radars-F2", "skein"): [(10, 0.1, 8.0)],
        ("radars-F2", "pso"): [(100, 1.0, 8.8)],
        ("radars-F2", "de"): [],
    }
    runs = [
        make_run(found, problem=problem, method=method, seed=seed)
        for (problem, method), found in lines.items()
        for seed in (1, 2)
    ]
    return Comparison(PROBLEMS, ("skein", "pso", "de"), (LIMIT,), {"forest-5-1": 10.0}, tuple(runs), ())


def test_gaps_are_from_what_is_known_or_was_found(comparison: Comparison) -> None:
    assert comparison.best_km == {"forest-5-1": 10.0, "radars-F2": 8.0}


def test_figures_of_each_method(comparison: Comparison) -> None:
    figures = comparison.figures(LIMIT, comparison.problems)
    assert figures["reference"] == "skein"
    pso = figures["methods"]["pso"]
    assert pso["runs"] == 4
    assert pso["gap"]["q3"] == pytest.approx(0.1)
    assert pso["within_0.01"]["success_rate"] == 0.5
    assert figures["methods"]["skein"]["within_0.001"] == {
        "success_rate": 1.0,
        # Reached after 10 evaluations in 15 and in 36 dimensions: the median of two is the lower.
        "evaluations_per_dimension": pytest.approx(10 / 36),
        "cpu_s": pytest.approx(0.1),
        "cpu_s_over_reference": pytest.approx(1.0),
    }
    assert [figures["methods"][method]["mean_rank"] for method in comparison.methods] == [1.0, 2.0, 3.0]
    assert figures["friedman_p"] == pytest.approx(math.exp(-2.0))
    assert figures["methods"]["skein"]["wilcoxon_p"] is None
    assert figures["methods"]["de"]["wilcoxon_holm_p"] == 1.0


def test_expected_running_times(comparison: Comparison) -> None:
    evaluations, cpu_s = comparison.running_times(LIMIT, "pso", PROBLEMS[0], 0.01)
    assert (evaluations, cpu_s) == (pytest.approx(500 / 15), pytest.approx(5.0))
    assert comparison.running_times(LIMIT, "pso", PROBLEMS[1], 0.01) == (math.inf, math.inf)


def test_json_has_everything_and_no_infinity(comparison: Comparison) -> None:
    data = json.loads(json.dumps(comparison.as_json(), allow_nan=False))
    assert set(data["summary"]["100/d"]["groups"]) == {"all", "forest", "paper"}
    assert set(data["summary"]["100/d"]["problems"]) == {"forest-5-1", "radars-F2"}
    assert data["summary"]["100/d"]["problems"]["radars-F2"]["methods"]["de"]["gap"]["median"] is None
    assert data["runs"][2]["lines"] == [[100, 1.0, 10.5], [500, 5.0, 10.05]]
    assert [entry["best_known_km"] for entry in data["problems"]] == [10.0, None]
