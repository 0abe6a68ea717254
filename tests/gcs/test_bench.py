"""`skein bench` as its users meet it."""

import json
import subprocess
import sys
from pathlib import Path

import pytest
from matplotlib.image import imread

from gcs.cli.bench import chosen_limits
from gcs.cli.bench_tables import family_table, kernel_table, method_table, together_table, work_table
from gcs.cli.output import WIDE, print_wide
from gcs.cli.workers import chosen_workers
from gcs.figures.bench import looks
from missions.errors import InputError
from planner.bench.comparison import Comparison
from planner.bench.count_work import KINDS
from planner.bench.job import Limit
from planner.bench.kernel_speed import KernelSpeed
from planner.bench.methods import METHODS, method_names
from planner.bench.problems import bench_problem


def skein(*arguments: str) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-m", "gcs.main", "bench", *arguments]
    return subprocess.run(command, capture_output=True, text=True, timeout=200)


def test_json_is_all_that_is_printed_and_figures_are_drawn(tmp_path: Path) -> None:
    problems = ("--problems", "radars-F2,forest-5-1", "--methods", "pso,hybrid", "--seeds", "2", "--jobs", "2")
    result = skein(*problems, "--budget", "20", "--time", "0.02", "--json", "--out", str(tmp_path))
    assert result.returncode == 0, result.stderr
    data = json.loads(result.stdout)
    assert len(data["runs"]) == 2 * 2 * 2 * 2
    assert data["limits"] == ["20/d", "0.02 s"]
    assert json.loads((tmp_path / "bench.json").read_text()) == data
    for name in ("ecdf.png", "convergence_evaluations.png", "convergence_time.png"):
        assert imread(tmp_path / name)[..., :3].std() > 0.03


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("--problems", "nowhere"), "skein: problem nowhere: there is none"),
        (("--quick", "--methods", "psso"), "skein: method psso: must be of"),
    ],
)
def test_what_is_not_there_is_one_line_and_2(arguments: tuple[str, ...], message: str) -> None:
    result = skein(*arguments)
    assert result.returncode == 2
    assert result.stdout == ""
    (line,) = result.stderr.strip().splitlines()
    assert message in line


def test_limits() -> None:
    assert chosen_limits("200,2000", 1.0) == (Limit(200), Limit(2000), Limit(cpu_s=1.0))
    assert chosen_limits("0", 0.5) == (Limit(cpu_s=0.5),)
    for budget in ("many", "-1", "", "1.5"):
        with pytest.raises(InputError, match="--budget"):
            chosen_limits(budget, 1.0)
    with pytest.raises(InputError, match="nothing is left to compare"):
        chosen_limits("0", 0.0)


def test_a_cluster_has_as_many_workers_as_it_has() -> None:
    with pytest.raises(InputError, match="--jobs and --cluster"):
        chosen_workers(2, "tcp://127.0.0.1:8786")


def test_all_methods_look_different() -> None:
    assert method_names("all") == tuple(METHODS)
    shown = looks(tuple(METHODS))
    assert len({(look["color"], str(look["linestyle"])) for look in shown.values()}) == len(METHODS)


def test_tables_fit_their_width(capsys: pytest.CaptureFixture[str]) -> None:
    problems = tuple(bench_problem(name) for name in ("forest-5-1", "walls-5-1", "canyons-5-1", "radars-F2"))
    nothing = Comparison(problems, tuple(METHODS), (Limit(200),), {}, (), ())
    print_wide(method_table(nothing, Limit(200)))
    print_wide(family_table(nothing, Limit(200)))
    kinds = dict.fromkeys(KINDS, 1e4)
    speed = KernelSpeed("mountains-leader", "raster", 1e6, 2e6, 1e4, 2, kinds, 1e-6, 0.5)
    print_wide(kernel_table([speed]))
    print_wide(work_table(kinds, [speed]))
    quartiles = {"q1": 0.0, "median": 0.1, "q3": None}
    row = {"scenario": "mountains", "method": "published", "runs": 30, "best_km": 259.6, "gap": quartiles}
    print_wide(together_table([row | {"success_rate": {"a": 1.0, "b": 0.5}, "plan_s": None}]))
    lines = capsys.readouterr().out.splitlines()
    assert any("mountains-leader" in line for line in lines)
    assert max(map(len, lines)) <= WIDE
    assert not any("…" in line for line in lines)
