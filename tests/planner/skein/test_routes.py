"""Routes through the plan view."""

from typing import Any

import numpy as np
import pytest

from planner.skein.routes import RouteGrid

TALL = 5000.0
GAP_Y_M = 4000.0


def fence(gap_y_m: float) -> list[tuple[float, float, float, float, float]]:
    """Tall cylinders across the area at x = 10 km, but for one gap."""
    return [(10000.0, y, 800.0, TALL, 100.0) for y in np.arange(-10000.0, 10001.0, 1000.0) if abs(y - gap_y_m) > 1900.0]


def y_at(route: np.ndarray, x_m: float) -> float:
    k = int(np.argmax(route[:, 0] >= x_m))
    part = (x_m - route[k - 1, 0]) / (route[k, 0] - route[k - 1, 0])
    return float(route[k - 1, 1] + part * (route[k, 1] - route[k - 1, 1]))


@pytest.mark.parametrize("gap_y_m", [-5000.0, 0.0, 6000.0])
def test_a_wall_with_one_gap_is_passed_through_the_gap(make_problem: Any, gap_y_m: float) -> None:
    grid = RouteGrid(make_problem(obstacles=fence(gap_y_m)))
    for rng in (None, np.random.default_rng(1), np.random.default_rng(2)):
        assert y_at(grid.route(rng=rng), 10000.0) == pytest.approx(gap_y_m, abs=1100.0)


def test_every_route_begins_at_the_origin_and_ends_at_the_target(draw_problem: Any) -> None:
    rng = np.random.default_rng(3)
    for _ in range(5):
        problem, _ = draw_problem(rng)
        route = RouteGrid(problem).route(rng=rng)
        assert np.array_equal(route[0], problem.origin_m[:2])
        assert np.array_equal(route[-1], problem.target_m[:2])
        inside = np.abs(route - (10000.0, 0.0)) <= (11000.0, 10000.0)
        assert inside.all()


def test_without_anything_the_route_is_nearly_straight(make_problem: Any) -> None:
    route = RouteGrid(make_problem()).route()
    assert np.abs(route[:, 1]).max() < 500.0
    assert np.hypot(*np.diff(route, axis=0).T).sum() < 1.01 * 20000.0


@pytest.mark.parametrize("side", [-1.0, 1.0])
def test_a_wall_forces_the_route_to_the_other_side(make_problem: Any, side: float) -> None:
    grid = RouteGrid(make_problem(radars=[(10000.0, 0.0, 500.0, 1500.0, 1500.0)]))
    wall = np.array([[10000.0, -300.0 * side], [10000.0, 1e6 * side]])
    assert y_at(grid.route(wall_m=wall), 10000.0) * side < 0.0
    free = grid.route()
    assert np.array_equal(grid.route(), free)  # a wall leaves nothing behind


def test_what_is_higher_than_one_can_climb_is_gone_round_and_what_is_lower_is_not(make_problem: Any) -> None:
    """A tower near the origin is too tall, the same one half way can be passed over."""
    near = make_problem(obstacles=[(3000.0, 0.0, 1000.0, 800.0, 100.0)], target=(20000.0, 0.0, 2500.0))
    far = make_problem(obstacles=[(10000.0, 0.0, 1000.0, 800.0, 100.0)], target=(20000.0, 0.0, 2500.0))
    assert abs(y_at(RouteGrid(near).route(), 3000.0)) > 1000.0
    assert abs(y_at(RouteGrid(far).route(), 10000.0)) < 500.0


def test_the_walled_in_get_a_route_all_the_same(make_problem: Any) -> None:
    """So that the search can say what stands in the way."""
    route = RouteGrid(make_problem(obstacles=fence(1e6))).route()
    assert route[0, 0] == 0.0
    assert route[-1, 0] == 20000.0
