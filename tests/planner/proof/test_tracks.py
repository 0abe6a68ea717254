"""All references at once are what each of them is, and never move more than their bounds say."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from missions.reference import Reference, fillet
from planner.proof.tracks import KINK_CURVATURE, Tracks

MakeReferences = Callable[..., list[Reference]]
seeds = st.integers(0, 2**32)


@settings(max_examples=10, deadline=None)
@given(seed=seeds)
def test_tracks_agree_with_their_references(make_references: MakeReferences, seed: int) -> None:
    references = make_references(seed, 3)
    tracks = Tracks(references)
    for i, reference in enumerate(references):
        t = np.linspace(0.0, reference.duration_s, 400)
        row = np.full(len(t), i)
        s, speed = tracks.progress(row, t)
        assert tracks.positions(row, t) == pytest.approx(reference.positions(t), abs=1e-6)
        assert tracks.slopes(row, s) == pytest.approx(reference.slopes(s), abs=1e-9)
        assert tracks.headings(row, s) == pytest.approx(reference.path.at(s)[2], abs=1e-9)
        assert tracks.times(row, s) == pytest.approx(t, abs=1e-6)
        assert np.gradient(s, t)[2:-2] == pytest.approx(speed[2:-2], abs=0.5)


@settings(max_examples=20, deadline=None)
@given(seed=seeds, width=st.floats(0.05, 10.0))
def test_no_flight_is_faster_or_more_accelerated_than_its_bounds(
    make_references: MakeReferences, seed: int, width: float
) -> None:
    tracks = Tracks(make_references(seed, 2))
    for i in range(2):
        start = np.random.default_rng(seed).uniform(0.0, tracks.durations_s[i] - width, 8)
        row = np.full(8, i)
        motion = tracks.motion(row, start, start + width)
        step = 0.01
        for k in range(8):
            t = np.arange(start[k], start[k] + width, step)
            positions = tracks.positions(np.full(len(t), i), t)
            velocities = np.diff(positions, axis=0) / step
            assert np.linalg.norm(velocities, axis=1).max() <= motion.speed_m_s[k] + 1e-6
            turned = np.linalg.norm(np.diff(velocities, axis=0), axis=1) / step
            assert turned.max(initial=0.0) <= motion.acceleration_m_s2[k] + 1e-4


def test_the_fastest_on_each_segment_is_seen(make_references: MakeReferences) -> None:
    (reference,) = make_references(1, 1)
    tracks = Tracks([reference])
    t = np.linspace(0.0, reference.duration_s, 5000)
    s, speed = tracks.progress(np.zeros(len(t), dtype=int), t)
    segment = np.searchsorted(reference.path.segments[:, 0], s, side="right") - 1
    fastest = tracks.fastest_m_s(0)
    assert len(fastest) == len(reference.path.segments)
    for k in range(len(fastest) - 1):
        assert speed[segment == k].max() <= fastest[k] + 1e-9
    assert fastest.max() <= reference.leg_ground_speed_m_s.max() * 1.001


def test_a_sharp_corner_is_touched_by_every_interval_through_it(make_references: MakeReferences) -> None:
    (reference,) = make_references(1, 1)
    sharp = replace(reference, path=fillet(np.array([[0.0, 0.0], [1000.0, 0.0], [2000.0, 500.0]]), 0.0))
    tracks = Tracks([sharp])
    row = np.zeros(3, dtype=int)
    shape = tracks.shape(row, np.array([0.0, 990.0, 1001.0]), np.array([990.0, 1001.0, 2000.0]))
    assert shape.curvature.tolist() == [0.0, KINK_CURVATURE, 0.0]
    s = np.linspace(0.0, sharp.length_m, 100)
    assert np.array_equal(tracks.points(np.zeros(100, dtype=int), s), sharp.points(s))
