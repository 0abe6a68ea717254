"""A raster's ground is bilinear between posts, level beyond them, and one in all its forms."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from missions.compiled import compile_shared
from missions.environment import Terrain, ground_height_and_slope, ground_height_m, ground_heights_m, slope_bound
from missions.environment.raster import BLOCK_CELLS, block_tops
from missions.environment.terrain import NO_WAVE


def rough(seed: int, ny: int = 7, nx: int = 9) -> Terrain:
    posts = np.random.default_rng(seed).uniform(-50.0, 400.0, (ny, nx))
    return Terrain(0.0, NO_WAVE, [], posts, -300.0, 150.0, 90.0, 70.0)


PLACES = st.tuples(st.floats(-600.0, 800.0), st.floats(-100.0, 900.0))


def test_posts_stand_where_they_were_put() -> None:
    terrain = rough(1)
    for j, i in np.ndindex(terrain.posts.shape):
        assert ground_height_m(-300.0 + 90.0 * i, 150.0 + 70.0 * j, terrain) == pytest.approx(terrain.posts[j, i])


def test_the_middle_of_a_cell_is_the_mean_of_its_posts() -> None:
    terrain = rough(2)
    assert ground_height_m(-255.0, 185.0, terrain) == pytest.approx(terrain.posts[:2, :2].mean())


@given(place=PLACES)
def test_beyond_the_outermost_posts_the_ground_is_level(place: tuple[float, float]) -> None:
    terrain = rough(3)
    x, y = place
    nearest = (min(max(x, -300.0), 420.0), min(max(y, 150.0), 570.0))
    assert ground_height_m(x, y, terrain) == pytest.approx(ground_height_m(*nearest, terrain), abs=1e-9)


@settings(deadline=None)  # the first call compiles
@given(seed=st.integers(0, 20), place=PLACES)
def test_plain_compiled_and_vectorised_agree(seed: int, place: tuple[float, float]) -> None:
    terrain = rough(seed)
    height = ground_height_m(*place, terrain)
    assert compile_shared(ground_height_m)(*place, terrain.as_array()) == height
    assert compile_shared(ground_height_and_slope)(*place, terrain.as_array()) == ground_height_and_slope(
        *place, terrain
    )
    assert ground_height_and_slope(*place, terrain)[0] == height
    assert ground_heights_m(np.array([place[0]]), np.array([place[1]]), terrain)[0] == pytest.approx(height, abs=1e-9)


@settings(max_examples=200)
@given(seed=st.integers(0, 20), place=PLACES)
def test_slopes_are_those_of_the_heights(seed: int, place: tuple[float, float]) -> None:
    terrain = rough(seed)
    x, y = place
    step = 1e-3
    cells = (x + 300.0) / 90.0, (y - 150.0) / 70.0
    if any(abs(one - round(one)) < 2e-4 for one in cells):
        return  # a seam, where there are two slopes
    _, slope_x, slope_y = ground_height_and_slope(x, y, terrain)
    by_x = (ground_height_m(x + step, y, terrain) - ground_height_m(x - step, y, terrain)) / (2 * step)
    by_y = (ground_height_m(x, y + step, terrain) - ground_height_m(x, y - step, terrain)) / (2 * step)
    assert (slope_x, slope_y) == pytest.approx((by_x, by_y), abs=1e-6)


@given(seed=st.integers(0, 2**32))
def test_the_slope_bound_is_reached_and_never_passed(seed: int) -> None:
    terrain = rough(seed, 4, 5)
    inside = np.array([1e-7, 0.5, 1.0 - 1e-7])
    u, v = np.add.outer(np.arange(4), inside).ravel(), np.add.outer(np.arange(3), inside).ravel()
    x, y = np.meshgrid(-300.0 + 90.0 * u, 150.0 + 70.0 * v)
    slopes = [np.hypot(*ground_height_and_slope(a, b, terrain)[1:]) for a, b in zip(x.flat, y.flat, strict=True)]
    bound = slope_bound(terrain)
    assert max(slopes) <= bound * (1 + 1e-12)
    assert max(slopes) == pytest.approx(bound, rel=1e-5)


@given(seed=st.integers(0, 2**32), ny=st.integers(2, 30), nx=st.integers(2, 30))
def test_a_block_is_as_high_as_its_highest_post(seed: int, ny: int, nx: int) -> None:
    posts = np.random.default_rng(seed).uniform(0.0, 1.0, (ny, nx))
    tops = block_tops(posts)
    for j, i in np.ndindex(tops.shape):
        rows, columns = (slice(k * BLOCK_CELLS, (k + 1) * BLOCK_CELLS + 1) for k in (j, i))
        assert tops[j, i] == posts[rows, columns].max()
    assert tops.shape == (-(-(ny - 1) // BLOCK_CELLS), -(-(nx - 1) // BLOCK_CELLS))
