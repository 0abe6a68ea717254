import math

import numpy as np
import pytest

from gcs.metrics.formation_error import formation_error
from gcs.metrics.tracks import Tracks
from sitl.formation.graph import edges

N_UAV, N_TICK = 9, 200
SYSIDS = tuple(range(11, 11 + N_UAV))


def exact() -> Tracks:
    """Everyone where the plan wants them."""
    planned = np.random.default_rng(1).normal(0.0, 1000.0, (N_UAV, N_TICK, 3))
    return Tracks(SYSIDS, np.arange(N_TICK) * 0.04, planned, planned.copy())


@pytest.mark.parametrize("kind", ["ring", "line", "star", "complete"])
def test_moving_all_together_is_no_error(kind: str) -> None:
    tracks = exact()
    tracks.flown_m[:] += [30.0, -40.0, 5.0]
    error = formation_error(tracks, edges(kind, SYSIDS))
    assert error.overall_rms_m == pytest.approx(0.0, abs=1e-9)


def test_one_vehicle_off_by_a_rigid_offset_counts_in_each_of_its_edges() -> None:
    tracks = exact()
    tracks.flown_m[4] += [3.0, 4.0, 12.0]
    error = formation_error(tracks, edges("ring", SYSIDS))
    assert error.overall_max_m == pytest.approx(13.0)
    assert error.overall_rms_m == pytest.approx(13.0 * math.sqrt(2 / N_UAV))
    np.testing.assert_allclose(error.rms_m, 13.0 * math.sqrt(2 / N_UAV))
    in_a_star = formation_error(tracks, edges("star", SYSIDS))
    assert in_a_star.overall_rms_m == pytest.approx(13.0 * math.sqrt(1 / (N_UAV - 1)))


def test_a_lost_vehicle_leaves_the_sum_at_its_loss() -> None:
    tracks = exact()
    tracks.flown_m[4] += [13.0, 0.0, 0.0]
    tracks.flown_m[4, 50:] = np.nan
    error = formation_error(tracks, edges("ring", SYSIDS))
    assert error.edges.tolist() == [N_UAV] * 50 + [N_UAV - 2] * (N_TICK - 50)
    terms = 50 * N_UAV + (N_TICK - 50) * (N_UAV - 2)
    assert error.overall_rms_m == pytest.approx(math.sqrt(50 * 2 * 13.0**2 / terms))
    np.testing.assert_allclose(error.max_m[50:], 0.0, atol=1e-9)


def test_is_unknown_without_edges_or_without_flights() -> None:
    alone = formation_error(exact(), ())
    assert (alone.overall_rms_m, alone.overall_max_m) == (None, None)
    tracks = exact()
    tracks.flown_m[:] = np.nan
    assert formation_error(tracks, edges("ring", SYSIDS)).overall_rms_m is None
