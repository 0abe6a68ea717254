"""No slope and no bend of the ground is beyond the bounds over a disc."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from missions.environment import Terrain, ground_heights_m
from missions.environment.terrain import NO_WAVE
from planner.proof.ground import ground_bounds

peaks = st.lists(
    st.tuples(
        st.floats(-800, 2000), st.floats(-500, 500), st.floats(-500, 500), st.floats(20, 4000), st.floats(20, 4000)
    ),
    min_size=1,
    max_size=4,
)


@settings(max_examples=60, deadline=None)
@given(peaks=peaks, x=st.floats(-900, 900), y=st.floats(-900, 900), radius=st.floats(1, 400), seed=st.integers(0, 99))
def test_slopes_and_downward_bends_within_a_disc_keep_to_the_bounds(
    peaks: list[tuple[float, ...]], x: float, y: float, radius: float, seed: int
) -> None:
    terrain = Terrain(0.0, NO_WAVE, peaks)
    bounds = ground_bounds(np.array([x]), np.array([y]), np.array([radius]), terrain)
    rng = np.random.default_rng(seed)
    step = 0.05
    angle, out = rng.uniform(0, 2 * np.pi, 300), (radius - step) * np.sqrt(rng.uniform(0, 1, 300))
    along = rng.uniform(0, 2 * np.pi, 300)
    px, py = x + out * np.cos(angle), y + out * np.sin(angle)
    before, here, after = (
        ground_heights_m(px + k * step * np.cos(along), py + k * step * np.sin(along), terrain) for k in (-1, 0, 1)
    )
    assert np.abs(after - before).max() / (2 * step) <= bounds.slope[0] + 1e-6
    assert (2 * here - before - after).max() / step**2 <= bounds.bend[0] + 1e-5


def test_the_bounds_are_reached_on_top_of_a_peak_and_on_its_flank() -> None:
    peak = Terrain(0.0, NO_WAVE, [(1000.0, 0.0, 0.0, 500.0, 500.0)])
    x = np.array([0.0, 500.0 / np.sqrt(2)])
    bounds = ground_bounds(x, np.zeros(2), np.full(2, 1e-6), peak)
    assert bounds.bend[0] == pytest.approx(2 * 1000 / 500**2, rel=1e-6)
    assert bounds.slope[1] == pytest.approx(1000 / 500 * np.sqrt(2 / np.e), rel=1e-6)


def test_a_wave_and_a_raster_are_bounded_by_their_steepest_slope_alone() -> None:
    posts = np.array([[0.0, 0.0], [100.0, 100.0]])
    raster = Terrain(0.0, NO_WAVE, [], posts=posts, spacing_x_m=50.0, spacing_y_m=50.0)
    wave = Terrain(0.0, (100.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0), [])
    for terrain, slope in ((raster, 2.0), (wave, 0.1)):
        bounds = ground_bounds(np.zeros(2), np.zeros(2), np.ones(2), terrain)
        assert bounds.slope == pytest.approx([slope, slope])
        assert np.all(np.isinf(bounds.bend))
