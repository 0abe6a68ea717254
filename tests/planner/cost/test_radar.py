"""The closed form of the radar integral against quadrature."""

import math
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import quad

from planner.cost.radar import radar_integral_m

RADAR = np.array([0.0, 0.0, 0.0, 1500.0, 900.0])
coordinate = st.floats(-2500.0, 2500.0)


def by_quadrature(p: np.ndarray, q: np.ndarray, radar: np.ndarray) -> float:
    centre, radius, delta = radar[:3], radar[3], radar[4]
    length = float(np.linalg.norm(q - p))

    def density(s: float) -> float:
        distance = float(np.linalg.norm(p + (q - p) * s / length - centre))
        return (delta / max(distance, 0.1 * radius)) ** 4 if distance <= radius else 0.0

    along = float((centre - p) @ (q - p)) / length
    rho = math.sqrt(max(0.0, float((centre - p) @ (centre - p)) - along**2))
    kinks = [along]
    for reach in (radius, 0.1 * radius):
        half = math.sqrt(max(0.0, reach**2 - rho**2))
        kinks += [along - half, along + half]
    points = sorted({0.0, length, *(k for k in kinks if 0 < k < length)})
    return sum(quad(density, a, b, epsrel=1e-10, limit=200)[0] for a, b in pairwise(points))


@settings(max_examples=100, deadline=None)
@given(p=st.tuples(coordinate, coordinate, coordinate), q=st.tuples(coordinate, coordinate, coordinate))
def test_closed_form_and_quadrature_agree(p: tuple[float, ...], q: tuple[float, ...]) -> None:
    start, end = np.array(p), np.array(q)
    if np.linalg.norm(end - start) < 1.0:
        end = start + 1.0
    expected = by_quadrature(start, end, RADAR)
    assert radar_integral_m(start, end, RADAR) == pytest.approx(expected, rel=1e-4, abs=1e-3)


@pytest.mark.parametrize("beside", [0.0, 0.1, 0.4, 1.0, 30.0, 149.0, 151.0])
def test_it_keeps_its_digits_near_the_centre(beside: float) -> None:
    start, end = np.array([-3000.0, beside, 0.0]), np.array([3000.0, beside, 0.0])
    assert radar_integral_m(start, end, RADAR) == pytest.approx(by_quadrature(start, end, RADAR), rel=1e-4)


def test_points_a_kilometre_apart_would_sum_to_about_the_same() -> None:
    """The integral per kilometre is the paper's sum over waypoints 1 km apart, on average over where they fall."""
    radar = np.array([0.0, 0.0, 0.0, 4000.0, 4000.0])
    start, end = np.array([-9000.0, 1500.0, 0.0]), np.array([9000.0, 1500.0, 0.0])
    x = np.arange(-9000.0, 9000.0, 10.0)
    distance = np.hypot(x, 1500.0)
    sums = np.where(distance <= 4000.0, (4000.0 / distance) ** 4, 0.0).reshape(-1, 100).sum(axis=0)
    assert radar_integral_m(start, end, radar) / 1000.0 == pytest.approx(sums.mean(), rel=0.01)


def test_a_leg_without_length_or_out_of_reach_costs_nothing() -> None:
    here = np.array([100.0, 0.0, 0.0])
    assert radar_integral_m(here, here, RADAR) == 0.0
    assert radar_integral_m(np.array([-9000.0, 1501.0, 0.0]), np.array([9000.0, 1501.0, 0.0]), RADAR) == 0.0
