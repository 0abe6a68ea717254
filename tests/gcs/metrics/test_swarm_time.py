"""A flight that went by a slowed or hurried clock is compared with its plan by that clock."""

import numpy as np
import pytest

from gcs.metrics.swarm_time import swarm_time
from gcs.metrics.tracks import Tracks, flown_tracks
from sitl.ticks import TICK_S

PLANNED = Tracks((1, 2), np.arange(1000) * TICK_S, np.zeros((2, 1000, 3)), np.full((2, 1000, 3), np.nan))


def along(t_s: np.ndarray, speed_m_s: float) -> np.ndarray:
    return np.outer(t_s, [speed_m_s, 0.0, 0.0, 0.0, 0.0, 0.0])


@pytest.mark.parametrize("rate", [0.25, -0.25])
def test_who_flies_as_planned_by_a_slowed_or_hurried_clock_has_no_error(rate: float) -> None:
    t_s = np.arange(1600) * TICK_S
    sums = np.stack([np.maximum(rate, 0.0) * t_s, np.maximum(-rate, 0.0) * t_s], axis=1)
    time = swarm_time({1: sums, 2: sums})
    shown = t_s * (1.0 - rate)
    np.testing.assert_allclose(time.shown_s, shown)
    tracks = flown_tracks(PLANNED, {1: along(shown, 20.0), 2: along(shown, 30.0)}, time)
    for row, speed_m_s in enumerate((20.0, 30.0)):
        np.testing.assert_allclose(tracks.flown_m[row, :, 0], PLANNED.t_s * speed_m_s, atol=1e-9)
    assert time.shown_at(8.0) == pytest.approx(8.0 * (1.0 - rate))


def test_the_clock_is_that_of_the_greatest_sums_and_goes_on_when_a_vehicle_has_arrived_or_is_lost() -> None:
    first = np.array([[0.0, 0.0], [1.0, 0.0], [2.0, 0.5], [0.0, 0.0]])
    time = swarm_time({1: first, 2: np.array([[0.0, 0.0], [0.5, 0.0]])})
    assert time.slowed_s.tolist() == [0.0, 1.0, 2.0, 2.0]
    assert time.hurried_s.tolist() == [0.0, 0.0, 0.5, 0.5]


def test_what_the_clock_never_showed_was_never_flown() -> None:
    time = swarm_time({1: np.zeros((500, 2))})
    tracks = flown_tracks(PLANNED, {1: along(np.arange(500) * TICK_S, 20.0)}, time)
    assert np.all(np.isfinite(tracks.flown_m[0, :500]))
    assert np.all(np.isnan(tracks.flown_m[0, 500:]))
