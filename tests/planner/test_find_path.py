"""The search for one UAV's path."""

import numpy as np
import pytest

from missions.errors import InputError
from missions.scenario import Scenario, load_scenario
from planner.cost.kernel import evaluate
from planner.find_path import PathFound, find_path, require_feasible


def small() -> Scenario:
    radars = load_scenario("radars")
    return radars.model_copy(update={"search": radars.search.model_copy(update={"iterations": 60, "population": 60})})


RADARS = small()


def found(vehicle: int, *earlier: PathFound, attempt: int = 0, seed: int = 1) -> PathFound:
    return find_path(
        RADARS,
        RADARS.vehicles[vehicle],
        earlier,
        method="hybrid",
        seed=seed,
        attempt=attempt,
        report=lambda *_: None,
    )


def test_both_readings_agree_on_what_was_found() -> None:
    path = found(1)
    assert path.feasible
    interior = path.corners_m[1:-1].reshape(1, -1)
    assert evaluate(interior, path.problem, "published")[0][0] == path.cost_km == path.history[-1]


def test_every_attempt_every_seed_and_every_vehicle_has_its_own_chance() -> None:
    paths = [found(2), found(2, attempt=1), found(2, seed=2), found(3)]
    for i, path in enumerate(paths):
        for other in paths[:i]:
            assert not np.array_equal(path.corners_m[1:-1], other.corners_m[1:-1])
    assert np.array_equal(found(2).corners_m, paths[0].corners_m)


def test_an_earlier_uav_in_the_way_is_avoided() -> None:
    """A UAV with nearly the same origin and target as another cannot have the same path."""
    first = found(2)
    assert len(first.problem.others) == 0
    twin = RADARS.vehicles[2].model_copy(update={"origin": (0.0, 8300.0, 0.0), "target": (25000.0, 18800.0, 2500.0)})
    second = find_path(RADARS, twin, [first], method="hybrid", seed=1, attempt=0, report=lambda *_: None)
    assert second.feasible
    assert second.problem.separations_m[0] > RADARS.limits.separation_m
    alongside = first.corners_m[1:-1].reshape(1, -1)
    _, terms = evaluate(alongside, second.problem, "published")
    assert terms[0, 3] > 0.0


def test_an_infeasible_path_is_an_error_with_the_reason() -> None:
    path = found(0)
    require_feasible("leader", path, 1)
    sunk = path.corners_m.copy()
    sunk[5, 2] = -100.0
    wrong = PathFound(path.problem, sunk, 2e9, 7, (2e9,))
    with pytest.raises(
        InputError, match=r"leader: no feasible path in 2 searches of 7 .* still goes through the ground"
    ):
        require_feasible("leader", wrong, 2)
