"""The height of a leg above a raster is exact: no sample of it is lower, and some sample is as low."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from missions.environment import Terrain, ground_heights_m
from missions.environment.terrain import NO_WAVE
from planner.cost.raster import least_height_above_raster_m
from planner.cost.terrain import leg_clearance_m

X0, Y0, SPACING_X, SPACING_Y = -1000.0, 500.0, 90.0, 75.0


def terrain_of(posts: np.ndarray) -> Terrain:
    return Terrain(0.0, NO_WAVE, [], posts, X0, Y0, SPACING_X, SPACING_Y).as_array()


def times(p: np.ndarray, q: np.ndarray, shape: tuple[int, int]) -> np.ndarray:
    """Dense, and every crossing of a line of posts among them."""
    crossings = []
    for axis, (first, spacing, count) in enumerate(((X0, SPACING_X, shape[1]), (Y0, SPACING_Y, shape[0]))):
        if p[axis] != q[axis]:
            crossings.append((first + spacing * np.arange(count) - p[axis]) / (q[axis] - p[axis]))
    t = np.concatenate([np.linspace(0.0, 1.0, 20001), *crossings])
    return t[(t >= 0.0) & (t <= 1.0)]


@st.composite
def legs(draw: st.DrawFn) -> tuple[Terrain, np.ndarray, np.ndarray]:
    """Rough ground or smooth, and a leg across it, along a line of posts, or past its edges."""
    rng = np.random.default_rng(draw(st.integers(0, 2**32)))
    ny, nx = draw(st.integers(2, 60)), draw(st.integers(2, 60))
    rough = rng.uniform(0.0, 800.0, (ny, nx))
    hills = 400.0 + 300.0 * np.add.outer(np.sin(np.arange(ny) / 7.0), np.cos(np.arange(nx) / 5.0))
    posts = draw(st.sampled_from([rough, hills, 0.02 * rough + hills]))
    low = X0 - 600.0, Y0 - 600.0, 0.0
    high = X0 + SPACING_X * nx + 600.0, Y0 + SPACING_Y * ny + 600.0, 1500.0
    p, q = rng.uniform(low, high, (2, 3))
    match draw(st.sampled_from(["across", "on posts", "from a post", "short", "east"])):
        case "on posts":
            p[1] = q[1] = Y0 + SPACING_Y * rng.integers(-1, ny + 1)
        case "from a post":
            p[:2] = X0 + SPACING_X * rng.integers(0, nx), Y0 + SPACING_Y * rng.integers(0, ny)
            q[:2] = X0 + SPACING_X * rng.integers(0, nx), Y0 + SPACING_Y * rng.integers(0, ny)
        case "short":
            q = p + rng.uniform(-20.0, 20.0, 3)
        case "east":
            q[1] = p[1]
    return terrain_of(posts), p, q


@settings(max_examples=300, deadline=None)
@given(leg=legs(), s0=st.sampled_from([0.0, 700.0, 1999.0, 5000.0]), grow=st.sampled_from([1.0, 1.4]))
def test_least_clearance_and_largest_shortfall_are_exact(
    leg: tuple[Terrain, np.ndarray, np.ndarray], s0: float, grow: float
) -> None:
    terrain, p, q = leg
    s1 = s0 + grow * float(np.linalg.norm(q - p)) + 1.0
    least, _, shortfall, _ = leg_clearance_m(p, q, s0, s1, terrain, 100.0, 2000.0)
    t = times(p, q, terrain.posts.shape)
    if s0 < 2000.0 < s1:
        t = np.append(t, (2000.0 - s0) / (s1 - s0))
    x, y, z = (p + t[:, None] * (q - p)).T
    above = z - ground_heights_m(x, y, terrain)
    wanted = 100.0 * np.minimum(1.0, (s0 + t * (s1 - s0)) / 2000.0)
    assert least <= above.min() + 1e-8
    assert least == pytest.approx(above.min(), abs=0.01)
    assert shortfall >= (wanted - above).max() - 1e-8
    assert shortfall == pytest.approx((wanted - above).max(), abs=0.01)


def test_a_needle_between_low_posts_is_seen_from_afar() -> None:
    posts = np.zeros((120, 120))
    posts[50, 70] = 900.0
    terrain = terrain_of(posts)
    x, y = X0 + 70 * SPACING_X, Y0 + 50 * SPACING_Y
    p, q = np.array([x - 5000.0, y, 500.0]), np.array([x + 3000.0, y, 500.0])
    assert least_height_above_raster_m(p, q, 500.0, 500.0, 0.0, 1.0, terrain)[0] == pytest.approx(-400.0)
    aside = np.array([0.0, SPACING_Y, 0.0])
    assert least_height_above_raster_m(p + aside, q + aside, 500.0, 500.0, 0.0, 1.0, terrain)[0] == pytest.approx(500.0)


def test_the_lowest_point_inside_a_cell_is_found() -> None:
    """Across a saddle, from low corner to low corner, the ground is highest in the middle of the cell."""
    saddle = terrain_of(np.array([[0.0, 200.0], [200.0, 0.0]]))
    p, q = np.array([X0, Y0, 150.0]), np.array([X0 + SPACING_X, Y0 + SPACING_Y, 150.0])
    assert leg_clearance_m(p, q, 5000.0, 5100.0, saddle, 100.0, 2000.0)[::2] == pytest.approx((50.0, 50.0))


def test_a_position_that_is_no_number_ends() -> None:
    terrain = terrain_of(np.zeros((20, 20)))
    nowhere = np.array([np.nan, np.nan, 100.0])
    least, _ = least_height_above_raster_m(nowhere, nowhere, 100.0, 100.0, 0.0, 1.0, terrain)
    assert np.isnan(least) or least >= 100.0
