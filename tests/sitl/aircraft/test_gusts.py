"""Gusts have the cited intensities and lengths, from the first tick on, and repeat by their key alone."""

import itertools
import math

import numpy as np
import pytest

from sitl.aircraft.gusts import (
    INTENSITIES_M_S,
    NOMINAL_AIRSPEED_M_S,
    NORMALS_PER_TICK,
    gust_filter,
    start_gusts,
    step_gusts,
    wind_at,
)
from sitl.noise import Stream, normals
from sitl.ticks import TICK_S

N = 400_000


def gusts(intensity: str, ticks: int, seed: int = 1, sysid: int = 1) -> np.ndarray:
    filters = gust_filter(intensity, TICK_S)
    draws = normals(seed, sysid, Stream.GUSTS, NORMALS_PER_TICK)
    state = start_gusts(next(draws), filters)
    rows = []
    for draw in itertools.islice(draws, ticks):
        rows.append(wind_at(state, filters, 0.0, (0.0, 0.0)))
        state = step_gusts(state, draw, filters)
    return np.array(rows)


@pytest.fixture(scope="module")
def light() -> np.ndarray:
    return gusts("light", N)


def test_intensities_are_those_of_the_table(light: np.ndarray) -> None:
    assert light.std(axis=0) == pytest.approx([1.06, 1.06, 0.7], rel=0.04)
    assert light.mean(axis=0) == pytest.approx([0, 0, 0], abs=0.06)


@pytest.mark.parametrize(("axis", "length_m"), [(0, 200.0), (2, 50.0)])
def test_the_spectrum_is_drydens(light: np.ndarray, axis: int, length_m: float) -> None:
    """Autocorrelation at lag r = V t / L: exp(-r) along, exp(-r) (1 - r/2) across and up."""
    lag = round(0.5 * length_m / NOMINAL_AIRSPEED_M_S / TICK_S)
    r = lag * TICK_S * NOMINAL_AIRSPEED_M_S / length_m
    expected = math.exp(-r) * (1.0 if axis == 0 else 1.0 - r / 2.0)
    x = light[:, axis]
    assert np.mean(x[lag:] * x[:-lag]) / x.var() == pytest.approx(expected, abs=0.04)


def test_the_first_tick_is_as_gusty_as_any() -> None:
    first = np.array([gusts("moderate", 1, sysid=sysid)[0] for sysid in range(1, 1500)])
    assert first.std(axis=0) == pytest.approx([2.12, 2.12, 1.4], rel=0.08)


def test_gusts_repeat_by_seed_and_vehicle_and_differ_between_them() -> None:
    assert (gusts("light", 600) == gusts("light", 600)).all()
    assert not np.allclose(gusts("light", 100), gusts("light", 100, seed=2))
    assert not np.allclose(gusts("light", 100), gusts("light", 100, sysid=2))


def test_no_gusts_means_steady_wind() -> None:
    assert INTENSITIES_M_S["none"] == (0.0, 0.0)
    filters = gust_filter("none", TICK_S)
    assert wind_at(start_gusts((1.0,) * 5, filters), filters, 1.0, (-3.0, 4.0)) == (-3.0, 4.0, 0.0)
