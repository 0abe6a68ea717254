"""The problems that searches are compared on."""

import numpy as np
import pytest

from missions.errors import InputError
from planner.bench.families import FAMILIES
from planner.bench.problems import QUICK, SIZES, bench_problem, problem_names, suite
from planner.cost.kernel import INFEASIBLE_KM, evaluate

DIGESTS = {
    "cylinders-12-3": "a5771bfa369dc33f",
    "canyons-20-4": "320456f2b850e9d0",
    "walls-20-3": "4fe95e359f4cdadd",
    "corridors-10-2": "5d6f2f5a009ae6eb",
    "forest-5-1": "07ff8a9729a338b6",
}
GENERATED = [name for name in suite() if name.partition("-")[0] in FAMILIES]


def cost_km(name: str, corners_m: np.ndarray) -> float:
    return float(evaluate(corners_m[1:-1].reshape(1, -1), bench_problem(name).problem, "graded")[0][0])


def test_the_suite_has_every_family_and_every_vehicle() -> None:
    assert len(GENERATED) == len(FAMILIES) * len(SIZES) == 30
    assert len(suite()) == 30 + 18
    assert set(QUICK) <= {*suite(), "forest-10-2"}


@pytest.mark.parametrize("name", GENERATED)
def test_a_generated_problem_has_a_way_but_not_straight_ahead(name: str) -> None:
    problem = bench_problem(name)
    assert problem.route_m is not None
    assert cost_km(name, problem.route_m) < INFEASIBLE_KM
    line = np.linspace(problem.problem.origin_m, problem.problem.target_m, problem.waypoints + 2)
    assert cost_km(name, line) > INFEASIBLE_KM


@pytest.mark.parametrize("name", ["cylinders-12-3", "canyons-10-2", "walls-20-3", "corridors-10-2", "forest-10-2"])
def test_the_same_name_is_the_same_problem(name: str) -> None:
    first = bench_problem(name)
    bench_problem.cache_clear()
    again = bench_problem(name)
    assert first.digest == again.digest
    for one, other in zip(first.problem[:5], again.problem[:5], strict=True):
        assert np.array_equal(one, other) if isinstance(one, np.ndarray) else str(one) == str(other)


def test_digests_stay() -> None:
    """Best-known values hang on them: when one of these changes, all best-knowns of its family are lost."""
    digests = {name: bench_problem(name).digest for name in DIGESTS}
    assert digests == DIGESTS


def test_another_number_is_another_draw_of_the_same_level() -> None:
    first, sixth, second = (bench_problem(f"walls-12-{number}") for number in (1, 6, 2))
    assert len({problem.digest for problem in (first, sixth, second)}) == 3
    assert first.problem.bounds == sixth.problem.bounds != second.problem.bounds


def test_names_families_and_lists_can_be_asked_for() -> None:
    assert problem_names("radars-F3,walls-20-3") == ("radars-F3", "walls-20-3")
    assert len(problem_names("walls")) == len(SIZES)
    assert len(problem_names("paper")) == 18
    assert problem_names("all") == suite()


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("wals-20-3", "problem wals-20-3: there is none; did you mean walls-20-"),
        ("radars-F9", "problem radars-F9: there is none; did you mean radars-F"),
        ("walls-3-1", "problem walls-3-1: 4 to 60 waypoints, got 3"),
        ("walls-20-0", "problem walls-20-0: there is none"),
        (",", "--problems: names no problem"),
    ],
)
def test_what_is_not_there(name: str, message: str) -> None:
    with pytest.raises(InputError, match=message.replace("?", "[?]")):
        problem_names(name)
