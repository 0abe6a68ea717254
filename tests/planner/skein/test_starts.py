"""Starts begin and end right, stay in the box, and lie above the ground where they can."""

from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from missions.environment import Terrain, ground_heights_m
from missions.environment.terrain import NO_WAVE
from planner.skein.routes import RouteGrid
from planner.skein.starts import bent_paths, jumped_paths, path_along, routed_paths, spacing


@settings(max_examples=30, deadline=None)
@given(seed=st.integers(0, 2**32), kind=st.sampled_from(["bent", "routed", "jumped"]))
def test_starts_lie_in_the_box_and_above_the_ground_where_they_can(draw_problem: Any, seed: int, kind: str) -> None:
    rng = np.random.default_rng(seed)
    problem, corners = draw_problem(rng)
    if kind == "bent":
        paths = bent_paths(problem, 5, 12, rng)
    elif kind == "routed":
        paths = routed_paths(RouteGrid(problem), problem, 5, 3, 2, rng)
    else:
        paths = jumped_paths(corners, problem, 6, rng)
    assert paths.shape[1:] == (7, 3)
    assert np.all(paths[:, 0] == problem.origin_m)
    assert np.all(paths[:, -1] == problem.target_m)
    b, inner = problem.bounds, paths[:, 1:-1]
    assert np.all((inner[..., 0] >= b.x_min_m) & (inner[..., 0] <= b.x_max_m))
    assert np.all((inner[..., 1] >= b.y_min_m) & (inner[..., 1] <= b.y_max_m))
    assert np.all(inner[..., 2] <= b.z_max_m)
    low = ground_heights_m(inner[..., 0], inner[..., 1], problem.terrain) + b.clearance_m
    away = np.hypot(inner[..., 0] - problem.origin_m[0], inner[..., 1] - problem.origin_m[1])
    left = np.hypot(inner[..., 0] - problem.target_m[0], inner[..., 1] - problem.target_m[1])
    highest = np.minimum(problem.origin_m[2] + b.slope_max * away, problem.target_m[2] - b.slope_min * left)
    reachable = (low + 30.0 < np.minimum(highest, b.z_max_m)) & (np.abs(inner[..., 0] - 10000.0) < 10990.0)
    assert np.all((inner[..., 2] >= low)[reachable & (np.abs(inner[..., 1]) < b.y_max_m - 10.0)])


def test_the_first_bent_path_is_the_straight_line(make_problem: Any) -> None:
    problem = make_problem(clearance_m=0.0, climb_out_m=1.0, target=(20000.0, 1000.0, 1000.0))
    first, *others = bent_paths(problem, 9, 5, np.random.default_rng(1))
    assert first[:, :2] == pytest.approx(np.linspace(problem.origin_m, problem.target_m, 11)[:, :2], abs=1e-6)
    assert all(np.abs(other[:, :2] - first[:, :2]).max() > 1.0 for other in others)


def test_a_path_along_a_route_has_its_corners_on_it(make_problem: Any) -> None:
    route = np.array([[0.0, 0.0], [10000.0, 5000.0], [20000.0, 0.0]])
    path = path_along(route, spacing(7, None), make_problem())
    assert path[4, :2] == pytest.approx([10000.0, 5000.0])
    assert path[2, :2] == pytest.approx([5000.0, 2500.0])


def test_a_path_along_a_route_rises_over_a_hill(make_problem: Any) -> None:
    hill = Terrain(0.0, NO_WAVE, [(800.0, 10000.0, 0.0, 1500.0, 1500.0)]).as_array()
    route = np.array([[0.0, 0.0], [20000.0, 0.0]])
    over, level = (path_along(route, spacing(9, None), make_problem(terrain=ground)) for ground in (hill, None))
    assert over[5, 2] >= 900.0 > level[5, 2]


@given(seed=st.integers(0, 2**32), waypoints=st.integers(1, 40))
def test_spacings_rise_from_0_to_1(seed: int, waypoints: int) -> None:
    parts = spacing(waypoints, np.random.default_rng(seed))
    assert (parts[0], len(parts)) == (0.0, waypoints + 2)
    assert parts[-1] == pytest.approx(1.0)
    assert np.all(np.diff(parts) >= 0.0)
