"""A vehicle's fence never ends its own flight, and keeps it out of all that this leaves."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from missions.environment import Area, Environment, Obstacle, Radar, Terrain
from missions.environment.terrain import NO_WAVE
from missions.fence import FenceCircle, FencePolygon
from missions.frame import LocalFrame
from missions.surroundings_fence import AREA_MARGIN_M, CIRCLE_MARGIN_M, surroundings_fence

FRAME = LocalFrame(46.5, 11.3, 400.0)
FLAT = Terrain(0.0, NO_WAVE, [])
AREA = Area(0.0, 10_000.0, 0.0, 8_000.0, 0.0, 3_000.0)
WAY = np.array([[x, 4_000.0, 500.0] for x in np.arange(1_000.0, 9_000.0, 20.0)])
E7_M = 0.02
"""What a fence's corners are rounded to, and more."""


def environment(radars: tuple[Radar, ...] = (), obstacles: tuple[Obstacle, ...] = ()) -> Environment:
    return Environment(AREA, FLAT, radars, obstacles)


def test_the_area_is_the_inclusion_polygon_where_the_way_stays_well_inside() -> None:
    fence, left_out = surroundings_fence(environment(), FRAME, WAY)
    (polygon,) = fence.areas
    assert isinstance(polygon, FencePolygon)
    assert polygon.inclusion
    corners = [FRAME.from_e7(*vertex) for vertex in polygon.vertices]
    assert corners == [pytest.approx(corner, abs=E7_M) for corner in ((0, 0), (10_000, 0), (10_000, 8_000), (0, 8_000))]
    assert left_out == ()


def test_a_radar_beside_the_way_is_fenced_out_and_one_that_it_crosses_is_left_out_by_name() -> None:
    beside = Radar(5_000.0, 6_500.0, 500.0, 1_500.0, 1_500.0)
    crossed = Radar(5_000.0, 4_500.0, 500.0, 1_500.0, 1_500.0)
    fence, left_out = surroundings_fence(environment(radars=(crossed, beside)), FRAME, WAY)
    assert fence.areas[1:] == (FenceCircle(False, FRAME.to_e7(5_000.0, 6_500.0), 1_500.0),)
    assert left_out == ("radars[0]",)


def test_a_building_that_the_way_leads_over_is_left_out() -> None:
    low = Obstacle(5_000.0, 4_000.0, 100.0, 50.0)
    fence, left_out = surroundings_fence(environment(obstacles=(low,)), FRAME, WAY)
    assert len(fence.areas) == 1
    assert left_out == ("obstacles[0]",)


PLACES = st.tuples(st.floats(-3_000.0, 13_000.0), st.floats(-3_000.0, 11_000.0))
WAYS = st.lists(PLACES, min_size=1, max_size=30).map(lambda places: np.array([(x, y, 500.0) for x, y in places]))
OBSTACLES = st.lists(
    st.builds(lambda place, radius_m: Obstacle(*place, radius_m, 900.0), PLACES, st.floats(10.0, 2_000.0)), max_size=5
)


@given(WAYS, OBSTACLES)
def test_every_point_of_the_way_keeps_its_margins_to_every_part_of_the_fence(
    way_m: np.ndarray, obstacles: list[Obstacle]
) -> None:
    fence, left_out = surroundings_fence(environment(obstacles=tuple(obstacles)), FRAME, way_m)
    polygon, *circles = fence.areas
    assert isinstance(polygon, FencePolygon)
    corners = np.array([FRAME.from_e7(*vertex) for vertex in polygon.vertices])
    assert (way_m[:, :2] >= corners.min(axis=0) + AREA_MARGIN_M - E7_M).all()
    assert (way_m[:, :2] <= corners.max(axis=0) - AREA_MARGIN_M + E7_M).all()
    for circle in circles:
        assert isinstance(circle, FenceCircle)
        x, y = FRAME.from_e7(*circle.center)
        assert min(math.hypot(px - x, py - y) for px, py, _ in way_m) >= circle.radius_m + CIRCLE_MARGIN_M - E7_M
    assert len(circles) + len(left_out) == len(obstacles)
