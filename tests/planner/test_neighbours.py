"""No pair that comes near is left out, whoever has moved; pairs far apart are."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from planner.neighbours import Neighbours

NEAR_M = 300.0


def progress(rng: np.random.Generator, lane: int) -> np.ndarray:
    """A wandering path; neighbouring lanes meet, far ones do not."""
    corners = np.column_stack(
        [np.linspace(0.0, 20000.0, 8), 600.0 * lane + rng.normal(0.0, 300.0, 8), rng.uniform(300.0, 600.0, 8)]
    )
    passed = np.append(0.0, np.cumsum(np.linalg.norm(np.diff(corners, axis=0), axis=1)))
    return np.column_stack([corners, passed / passed[-1]])


def positions(path: np.ndarray) -> np.ndarray:
    moments = np.linspace(0.0, 1.0, 2001)
    return np.stack([np.interp(moments, path[:, 3], path[:, axis]) for axis in range(3)], axis=1)


@settings(max_examples=30, deadline=None)
@given(seed=st.integers(0, 2**32), moves=st.integers(0, 12))
def test_all_who_come_near_are_found_by_both(seed: int, moves: int) -> None:
    rng = np.random.default_rng(seed)
    paths = [progress(rng, lane) for lane in range(12)]
    neighbours = Neighbours(paths, NEAR_M)
    for i in rng.integers(0, 12, moves):
        paths[i] = progress(rng, int(rng.integers(0, 12)))
        neighbours.move(int(i), paths[i])
    tracks = [positions(path) for path in paths]
    for i in range(12):
        found = neighbours.of(i)
        assert found == sorted(set(found) - {i})
        for j in range(12):
            apart = np.linalg.norm(tracks[i] - tracks[j], axis=1).min()
            if j != i and apart < NEAR_M:
                assert j in found
            if apart > NEAR_M + 1000.0:
                assert j not in found


def test_a_lonely_uav_has_no_neighbours() -> None:
    assert Neighbours([progress(np.random.default_rng(1), 0)], NEAR_M).of(0) == []
