"""The two forms of the ground, for one point and for arrays, are the same equation (2)."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from missions.compiled import compile_shared
from missions.environment import Terrain, ground_height_and_slope, ground_height_m, ground_heights_m, slope_bound
from missions.environment.terrain import NO_WAVE
from missions.scenario import load_scenario

MOUNTAINS = load_scenario("mountains").environment.terrain
WAVY = MOUNTAINS._replace(wave=(300.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7))
place = st.floats(-10_000, 50_000)


@pytest.mark.parametrize("terrain", [MOUNTAINS, WAVY, Terrain(120.0, NO_WAVE, [])])
@given(x=place, y=place)
def test_one_point_and_arrays_agree(terrain: Terrain, x: float, y: float) -> None:
    heights = ground_heights_m(np.array([x]), np.array([y]), terrain)
    assert ground_height_m(x, y, terrain) == pytest.approx(heights[0], abs=1e-6)


def test_the_summit_of_table_2_stands_where_the_paper_puts_it() -> None:
    assert ground_height_m(10_000, 30_000, MOUNTAINS) == pytest.approx(2000, abs=1)


def test_a_peak_declines_by_one_over_e_at_its_decline() -> None:
    alone = Terrain(0.0, NO_WAVE, [(1000.0, 0.0, 0.0, 2000.0, 4000.0)])
    assert ground_height_m(2000, 0, alone) == pytest.approx(1000 / math.e)
    assert ground_height_m(0, 4000, alone) == pytest.approx(1000 / math.e)


def test_the_wave_only_shows_where_it_is_higher() -> None:
    x = np.linspace(0, 40_000, 200)
    assert (ground_heights_m(x, x, WAVY) >= ground_heights_m(x, x, MOUNTAINS)).all()


@pytest.mark.parametrize("terrain", [MOUNTAINS, WAVY])
@settings(deadline=None)  # the first call compiles
@given(x=st.floats(-5000, 45_000), y=st.floats(-5000, 35_000))
def test_slopes_are_those_of_the_heights_and_within_their_bound(terrain: Terrain, x: float, y: float) -> None:
    height, *slope = ground_height_and_slope(x, y, terrain)
    assert height == ground_height_m(x, y, terrain)
    compiled = compile_shared(ground_height_and_slope)(x, y, terrain.as_array())
    assert compiled == (height, *slope)
    assert math.hypot(*slope) <= slope_bound(terrain)
    step = 0.01
    near = [ground_height_m(x + dx, y + dy, terrain) for dx, dy in ((step, 0), (-step, 0), (0, step), (0, -step))]
    by_differences = (near[0] - near[1]) / (2 * step), (near[2] - near[3]) / (2 * step)
    upward = (near[0] + near[1] - 2 * height) / step, (near[2] + near[3] - 2 * height) / step
    if max(map(abs, upward)) < 1e-4:  # no kink between wave and peaks here
        assert slope == pytest.approx(by_differences, abs=1e-3)


def test_a_lone_peak_is_as_steep_as_its_bound() -> None:
    alone = Terrain(0.0, NO_WAVE, [(1000.0, 0.0, 0.0, 2000.0, 4000.0)])
    _, slope_x, slope_y = ground_height_and_slope(2000 / math.sqrt(2), 0.0, alone)
    assert -slope_x == pytest.approx(slope_bound(alone), rel=1e-12)
    assert slope_y == 0.0
