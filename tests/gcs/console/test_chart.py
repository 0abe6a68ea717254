"""What part of the world is shown, and how large."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from gcs.console.chart import SIDE, SMALLEST_M, Chart, chart_around, chart_of
from gcs.figures.paths import Ground

metres = st.floats(-1e5, 1e5)
points = st.tuples(metres, metres, st.floats(0.0, 1e4))
charts = st.builds(
    lambda x, y, z, wide, deep, high, heights: Chart((x, y, z), (x + wide, y + deep, z + high), heights),
    metres, metres, metres,
    st.floats(1.0, 1e5), st.floats(1.0, 1e5), st.floats(1.0, 1e4), st.sampled_from((1, 2, 10, 50)),
)  # fmt: skip


def flat_ground(side_m: float, z_m: float) -> Ground:
    axis = np.linspace(0.0, side_m, 3)
    return Ground(axis, axis, np.full((3, 3), z_m))


def test_a_square_of_ten_kilometres_is_ten_units_wide_around_the_origin_on_its_lowest_ground() -> None:
    chart = Chart((0.0, 0.0, 500.0), (10_000.0, 10_000.0, 1500.0), heights=2)
    corners = chart.units([(0.0, 0.0, 500.0), (10_000.0, 10_000.0, 1500.0)])
    assert corners.tolist() == [[-5.0, -5.0, 0.0], [5.0, 5.0, 2.0]]


@given(charts, points, points)
def test_distances_on_the_level_and_in_height_keep_their_proportions(
    chart: Chart, one: tuple[float, float, float], other: tuple[float, float, float]
) -> None:
    drawn = chart.units(other) - chart.units(one)
    flown = np.array(other) - np.array(one)
    scale = chart.units_per_m * np.array([1.0, 1.0, chart.heights])
    assert drawn == pytest.approx(flown * scale, abs=1e-9 * SIDE * 1e5)


@given(charts)
def test_all_of_a_chart_lies_within_its_side(chart: Chart) -> None:
    low, high = chart.units([chart.low_m, chart.high_m])
    assert np.abs([low[:2], high[:2]]).max() <= SIDE / 2.0 * (1.0 + 1e-9)
    assert low[2] == 0.0


def test_many_points_go_at_once_whatever_their_axes() -> None:
    chart = Chart((0.0, 0.0, 0.0), (2000.0, 1000.0, 100.0), heights=1)
    ways = np.arange(24.0).reshape(2, 4, 3)
    assert chart.units(ways).shape == (2, 4, 3)
    assert np.array_equal(chart.units(ways)[1, 2], chart.units(ways[1, 2]))


def test_low_flight_over_wide_ground_is_drawn_higher_and_steep_ground_as_it_is() -> None:
    assert chart_of(flat_ground(10_000.0, 0.0), top_m=100.0).heights == 20
    assert chart_of(flat_ground(10_000.0, 0.0), top_m=3000.0).heights == 1
    assert chart_of(flat_ground(10_000.0, 0.0), top_m=9000.0).heights == 1


def test_a_chart_reaches_above_ground_that_is_higher_than_what_flies() -> None:
    ground = flat_ground(10_000.0, 0.0)
    ground.z_m[1, 1] = 800.0
    chart = chart_of(ground, top_m=300.0)
    assert (chart.low_m[2], chart.high_m[2]) == (0.0, 800.0)


@given(st.lists(points, min_size=1, max_size=9))
def test_vehicles_of_which_nothing_else_is_known_are_in_the_middle_of_their_chart(
    places: list[tuple[float, float, float]],
) -> None:
    drawn = chart_around(places).units(places)
    assert np.abs(drawn[:, :2]).max() <= SIDE / 6.0 * (1.0 + 1e-6), "as much around them on either side"
    assert drawn[:, 2].min() == pytest.approx(0.0, abs=1e-9)


def test_vehicles_on_one_spot_are_not_shown_any_larger() -> None:
    assert chart_around([(1.0, 2.0, 3.0)] * 3).units_per_m == pytest.approx(SIDE / (2.0 * SMALLEST_M))
