"""Routes searched for formations: room for all where there is, for a narrower one where there is not."""

import numpy as np
import numpy.typing as npt
import pytest

from missions.environment import Terrain, ground_heights_m
from missions.environment.terrain import NO_WAVE
from missions.errors import InputError
from missions.scenario import Scenario, load_scenario
from planner.cost.problem import PathProblem
from planner.find_route import WIDTHS, find_route, route_problem, widened
from planner.plan import plan
from planner.verify import verify

VEE = load_scenario("vee")
HALF_WIDTH_M = 400.0
ENDS = {"origin": (0.0, 0.0, 0.0), "target": (18000.0, 0.0, 300.0), "ground_speed_m_s": 28.0}


def searched(**changes: object) -> Scenario:
    """A V of nine, 800 m wide, between two ends; a small search."""
    kept = {name: getattr(VEE, name) for name in Scenario.model_fields if name not in ("vehicles", "route", "area")}
    search = VEE.search.model_copy(update={"waypoints": 3, "population": 60, "iterations": 60})
    return Scenario.model_validate(
        {
            **kept,
            "area": {"x_m": (-4e3, 30e3), "y_m": (-6e3, 6e3), "z_m": (0.0, 600.0)},
            "shape": {"pattern": "vee", "count": 9, "width_m": 2 * HALF_WIDTH_M},
            "route": ENDS,
            "search": search,
            **changes,
        }
    )


TOWERS = [{"x_m": 9000.0, "y_m": y, "radius_m": 700.0, "height_m": 500.0} for y in (-900.0, 900.0)]


def test_a_route_is_found_around_towers_and_the_plan_is_sound() -> None:
    scenario = searched(obstacles=TOWERS)
    result = plan(scenario)
    assert verify(result, scenario).violations == ()
    assert len(result.slot_scale) == len(result.uavs[0].waypoints_m)
    leader = result.uavs[0].waypoints_m
    assert leader[[0, -1]] == pytest.approx(np.array([ENDS["origin"], ENDS["target"]]), abs=1e-6)
    assert [uav.waypoints_m.tolist() for uav in plan(scenario).uavs] == [
        uav.waypoints_m.tolist() for uav in result.uavs
    ]


def test_narrower_formations_are_tried_one_after_the_other() -> None:
    """Of paths through the gap, one is refused until only a quarter of the width is asked for."""
    scenario = searched(obstacles=TOWERS)
    kept: list[float] = []
    route = np.array([(0.0, 0.0, 0.0), (6000.0, 0.0, 250.0), (12000.0, 0.0, 280.0), (18000.0, 0.0, 300.0)])

    def through_the_gap(problem: PathProblem, waypoints: int) -> npt.NDArray[np.float64] | None:
        kept.append(float(problem.obstacles[0, 4]))
        return route if kept[-1] <= 145.0 + 0.25 * HALF_WIDTH_M + 1e-6 else None

    through = [(x, y, z) for x, y, z in route.tolist()]
    through.insert(2, (9000.0, 0.0, 265.0))
    route = np.array(through)
    slots = find_route(scenario, through_the_gap)
    assert kept == pytest.approx([145.0 + share * HALF_WIDTH_M for share in WIDTHS[:4]])
    assert slots.fit.scale[2] < 0.5


def test_a_formation_deeper_than_its_legs_are_steep_for_finds_a_route() -> None:
    """Legs long enough for all of a column's 2 km would climb too gently to reach the target."""
    column = searched(
        shape={"pattern": "column", "count": 9, "spacing_m": 250.0}, route=ENDS | {"target": (18000.0, 0.0, 560.0)}
    )
    result = plan(column)
    assert verify(result, column).violations == ()


def test_without_any_path_the_scenario_and_the_reason_are_named() -> None:
    with pytest.raises(InputError, match="vee: route: no path was found between its ends whose legs are"):
        find_route(searched(), lambda problem, waypoints: None)


def test_a_path_that_no_width_fits_tells_why() -> None:
    xy = [(0.0, 0.0), (5000.0, 0.0), (5100.0, 3000.0), (11000.0, 1500.0), (18000.0, 0.0)]
    sharp = np.array([(x, y, min(x / 20.0, 300.0)) for x, y in xy])
    with pytest.raises(InputError, match=r"vee: route: vee: route\.points\[1\].*lead: .*; move its ends"):
        find_route(searched(), lambda problem, waypoints: sharp)


def test_a_route_leaves_room_on_both_sides() -> None:
    alone, all_of_it = (route_problem(searched(obstacles=TOWERS), share) for share in (0.0, 1.0))
    assert all_of_it.obstacles[:, 4] == pytest.approx(alone.obstacles[:, 4] + HALF_WIDTH_M)
    assert all_of_it.bounds.y_max_m == alone.bounds.y_max_m - HALF_WIDTH_M
    assert all_of_it.bounds.leg_min_m > alone.bounds.leg_min_m
    assert all_of_it.bounds.leg_max_m < VEE.limits.leg_max_m


def test_widened_ground_is_nowhere_lower_than_near_by() -> None:
    heights = np.random.default_rng(0).uniform(0.0, 100.0, (9, 11))
    raster = Terrain(0.0, NO_WAVE, [], posts=heights, spacing_x_m=50.0, spacing_y_m=80.0).as_array()
    wide = widened(raster, 160.0)
    for row, column in np.ndindex(heights.shape):
        y, x = np.ogrid[:9, :11]
        near = np.hypot((x - column) * 50.0, (y - row) * 80.0) <= 160.0
        assert wide.posts[row, column] == heights[near].max()
    peak = Terrain(0.0, NO_WAVE, [(500.0, 0.0, 0.0, 400.0, 400.0), (-50.0, 900.0, 0.0, 90.0, 90.0)]).as_array()
    x = np.linspace(-3000.0, 3000.0, 200)
    before, after = (ground_heights_m(x, np.zeros(200), terrain) for terrain in (peak, widened(peak, 100.0)))
    assert np.all(after >= before - 1e-9)
    assert widened(peak, 0.0) is peak
