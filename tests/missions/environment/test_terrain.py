"""The two forms of the ground, for one point and for arrays, are the same equation (2)."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from missions.environment import Terrain, ground_height_m, ground_heights_m
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
