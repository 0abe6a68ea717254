"""On which side a path passes a threat, by hand."""

from typing import Any

import numpy as np
import pytest

from planner.skein.routes import RouteGrid
from planner.skein.sides import ABOVE, BELOW, LEFT, RIGHT, classes, on_other_sides, sides, threats

RADAR = (10000.0, 0.0, 1000.0, 800.0, 800.0)
TOWER = (10000.0, 0.0, 500.0, 900.0, 100.0)


def path(y_m: float, z_m: float) -> np.ndarray:
    """Past x = 10 km at y and z."""
    return np.array([[0, 0, 0], [5000, y_m, z_m], [15000, y_m, z_m], [20000, 0, 1000]], dtype=np.float64)


def side_of(corners: np.ndarray, around: np.ndarray) -> list[int]:
    out = np.zeros(len(around), dtype=np.int8)
    sides(corners, around, out)
    return out.tolist()


@pytest.mark.parametrize(
    ("y_m", "z_m", "side"),
    [(900, 1000, LEFT), (-900, 1000, RIGHT), (100, 1900, ABOVE), (-100, 100, BELOW), (2000, 1900, LEFT)],
)
def test_a_radar_is_passed_on_four_sides(make_problem: Any, y_m: float, z_m: float, side: int) -> None:
    around = threats(make_problem(radars=[RADAR]))
    assert side_of(path(y_m, z_m), around) == [side]


@pytest.mark.parametrize(("y_m", "z_m", "side"), [(700, 500, LEFT), (-700, 500, RIGHT), (50, 1200, ABOVE)])
def test_an_obstacle_is_passed_left_right_or_above(make_problem: Any, y_m: float, z_m: float, side: int) -> None:
    around = threats(make_problem(obstacles=[TOWER]))
    assert side_of(path(y_m, z_m), around) == [side]


def test_backwards_left_is_right(make_problem: Any) -> None:
    around = threats(make_problem(radars=[RADAR]))
    assert side_of(path(900, 1000)[::-1].copy(), around) == [RIGHT]


def test_threats_are_radars_then_obstacles(make_problem: Any) -> None:
    around = threats(make_problem(radars=[RADAR], obstacles=[TOWER]))
    assert around.tolist() == [[10000, 0, 1000, 800, 800], [10000, 0, 0, 600, 1000]]
    assert threats(make_problem()).shape == (0, 5)


def test_paths_of_a_class_share_its_name(make_problem: Any) -> None:
    around = threats(make_problem(radars=[RADAR, (15000.0, 3000.0, 500.0, 500.0, 500.0)]))
    names = classes([path(900, 1000), path(1500, 900), path(-900, 1000)], around)
    assert names[0] == names[1] != names[2]
    assert classes([path(900, 1000)], threats(make_problem())) == [b""]


def test_who_touches_a_radar_gets_its_other_side_and_above_and_below(make_problem: Any) -> None:
    problem = make_problem(radars=[RADAR])
    part = np.linspace(0.0, 1.0, 14)[:, None]
    corners = problem.origin_m + part * (problem.target_m - problem.origin_m)
    corners[1:-1, 1] = 400.0
    corners[1:-1, 2] = 1000.0
    around = threats(problem)
    found = on_other_sides(corners, problem, around, RouteGrid(problem), np.random.default_rng(1))
    assert {side_of(other, around)[0] for other in found} == {RIGHT, ABOVE, BELOW}
    for other in found:
        assert np.array_equal(other[[0, -1]], corners[[0, -1]])


def test_who_passes_far_away_or_over_an_obstacle_gets_nothing(make_problem: Any) -> None:
    rng = np.random.default_rng(1)
    for problem, corners in (
        (make_problem(radars=[RADAR]), path(2000, 1000)),
        (make_problem(obstacles=[TOWER]), path(0, 1500)),
    ):
        assert on_other_sides(corners, problem, threats(problem), RouteGrid(problem), rng) == []
