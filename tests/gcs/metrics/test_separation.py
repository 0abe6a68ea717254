import numpy as np
import pytest
from scipy.spatial.distance import pdist

from gcs.metrics.separation import least_separation_m


def test_is_the_least_of_all_pairs_at_each_tick() -> None:
    positions = np.random.default_rng(2).normal(0.0, 500.0, (9, 40, 3))
    expected = [pdist(positions[:, tick]).min() for tick in range(40)]
    np.testing.assert_allclose(least_separation_m(positions), expected)


def test_the_least_over_time_is_found_where_two_cross() -> None:
    ticks = np.arange(-100, 101, dtype=np.float64)
    eastward = np.stack([ticks, np.zeros(201), np.zeros(201)], axis=-1)
    northward = np.stack([np.zeros(201), ticks, np.full(201, 70.0)], axis=-1)
    assert least_separation_m(np.stack([eastward, northward])).min() == pytest.approx(70.0)


def test_a_vehicle_that_is_not_known_is_near_no_one() -> None:
    positions = np.zeros((3, 4, 3))
    positions[1] += [100.0, 0.0, 0.0]
    positions[2, :2] += [0.0, 10.0, 0.0]
    positions[2, 2:] = np.nan
    np.testing.assert_allclose(least_separation_m(positions), [10.0, 10.0, 100.0, 100.0])


def test_one_vehicle_has_no_separation() -> None:
    assert np.isnan(least_separation_m(np.zeros((1, 4, 3)))).all()
