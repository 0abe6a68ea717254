"""Distances at every instant, against samples every hundredth of a second of all pairs."""

from collections.abc import Callable
from itertools import combinations

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from missions.reference import Reference
from planner.proof.bracket import RESOLUTION_M
from planner.proof.separation import separations
from planner.proof.tracks import Tracks

MakeReferences = Callable[..., list[Reference]]


def sampled(references: list[Reference]) -> dict[tuple[int, int], float]:
    """Least distance of every pair at samples."""
    found = {}
    for i, j in combinations(range(len(references)), 2):
        end = min(references[i].duration_s, references[j].duration_s)
        t = np.append(np.arange(0.0, end, 0.01), end)
        apart = references[i].positions(t) - references[j].positions(t)
        found[i, j] = float(np.linalg.norm(apart, axis=1).min())
    return found


@settings(max_examples=25, deadline=None)
@given(
    seed=st.integers(0, 2**32),
    count=st.integers(2, 6),
    spread=st.floats(20.0, 2000.0),
    wanted=st.floats(5.0, 400.0),
)
@example(seed=462, count=6, spread=782.0, wanted=131.0)  # a pair nearest in a window where it does not matter
def test_every_pair_is_proven_or_shown(
    make_references: MakeReferences, seed: int, count: int, spread: float, wanted: float
) -> None:
    references = make_references(seed, count, leg_m=max(700.0, 2.0 * spread), spread_m=spread)
    truth = sampled(references)
    found = separations(Tracks(references), wanted)
    known = {tuple(pair): k for k, pair in enumerate(found.pairs.tolist())}
    for pair, distance in truth.items():
        if pair not in known:
            assert distance >= wanted
            continue
        k = known[pair]
        assert found.of_pair.low[k] <= distance + 1e-9
        if distance < wanted:
            assert found.of_pair.low[k] >= distance - RESOLUTION_M - 0.2  # two meet at 60 m/s: 0.3 m a sample
            t = np.array(found.of_pair.at[k])
            there = np.linalg.norm(references[pair[0]].positions(t) - references[pair[1]].positions(t))
            assert there <= found.of_pair.value[k] + 1e-6
    for i in range(count):
        nearest = min(distance for pair, distance in truth.items() if i in pair)
        assert nearest - RESOLUTION_M - 0.2 <= found.nearest_m[i] <= nearest + 1e-9


def test_a_meeting_shorter_than_any_sampling_step_is_found(make_references: MakeReferences) -> None:
    towards, away = make_references(5, 1, spread_m=0.0)[0], make_references(6, 1, spread_m=0.0)[0]
    tracks = Tracks([towards, away])
    # The second UAV flies the other way along the same line, 3 m beside the first.
    tracks.segments.table[tracks.segments.row == 1, 1:3] = (2800.0 + 13.0, 3.0)
    tracks.segments.table[tracks.segments.row == 1, 3] = np.pi
    start = tracks.segments.table[tracks.segments.row == 1, 0]
    tracks.segments.table[tracks.segments.row == 1, 1] -= start
    found = separations(tracks, 75.0)
    row = np.zeros(2, dtype=int)
    t = np.repeat(found.of_pair.at, 2)
    apart = tracks.positions(row, t) - tracks.positions(row + 1, t)
    level = float(abs(apart[0, 2]))
    assert found.nearest_m[0] == pytest.approx(np.hypot(3.0, level), abs=0.5)
    assert abs(apart[0, 0]) < 0.5


def test_one_alone_is_near_nobody(make_references: MakeReferences) -> None:
    found = separations(Tracks(make_references(0, 1)), 200.0)
    assert found.nearest_m.tolist() == [np.inf]
    assert len(found.pairs) == 0


def test_in_a_wide_field_each_uav_is_compared_with_its_neighbours_only(make_references: MakeReferences) -> None:
    references = make_references(2, 1, legs=3, spread_m=0.0) * 60
    tracks = Tracks(references)
    tracks.segments.table[:, 2] += 500.0 * tracks.segments.row
    found = separations(tracks, 200.0)
    assert len(found.pairs) < 3 * 60
    assert found.nearest_m == pytest.approx(np.full(60, 500.0), abs=RESOLUTION_M)
