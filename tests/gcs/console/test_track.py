"""Where a vehicle was between what it said of itself."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from gcs.console.track import AHEAD_S, KEPT, TRAIL, Sample, Track, between

coefficients = st.tuples(*[st.floats(-10.0, 10.0)] * 4)
angles = st.floats(-math.pi, math.pi)


def sample(t_s: float, x_m: float = 0.0, v_m_s: float = 0.0, heading: float = 0.0) -> Sample:
    return Sample(t_s, (x_m, 0.0, 0.0), (v_m_s, 0.0, 0.0), (0.0, 0.0, heading))


def track_of(*samples: Sample) -> Track:
    track = Track()
    for one in samples:
        track.add(one)
    return track


@given(st.tuples(coefficients, coefficients, coefficients), st.floats(0.02, 3.0), st.floats(0.0, 1.0))
def test_cubic_motion_is_met_exactly(axes: tuple[tuple[float, ...], ...], span_s: float, share: float) -> None:
    cubics = [np.polynomial.Polynomial(axis) for axis in axes]

    def on_them(t_s: float) -> Sample:
        x, y, z = (float(cubic(t_s)) for cubic in cubics)
        u, v, w = (float(cubic.deriv()(t_s)) for cubic in cubics)
        return Sample(t_s, (x, y, z), (u, v, w), (0.0, 0.0, 0.0))

    t_s = share * span_s
    position, _ = between(on_them(0.0), on_them(span_s), t_s)
    assert position == pytest.approx(on_them(t_s).position_m, abs=1e-9)


@given(angles, angles, st.floats(0.0, 1.0))
def test_angles_take_the_shorter_way(first: float, last: float, share: float) -> None:
    _, attitude = between(sample(0.0, heading=first), sample(1.0, heading=last), share)
    way = math.remainder(last - first, 2.0 * math.pi)
    if abs(way) < math.pi - 1e-9:
        assert math.remainder(attitude[2] - first, 2.0 * math.pi) == pytest.approx(share * way, abs=1e-9)
    assert abs(attitude[2] - first) <= math.pi + 1e-9


def test_through_south_west_heading_does_not_go_all_the_way_round() -> None:
    track = track_of(sample(0.0, heading=math.radians(170.0)), sample(1.0, heading=math.radians(-170.0)))
    _, attitude = track.at(0.5)
    assert math.degrees(attitude[2]) == pytest.approx(180.0)


@given(st.lists(st.floats(0.01, 5.0), min_size=1, max_size=30))
def test_at_each_sample_that_is_kept_it_is_that_sample(steps_s: list[float]) -> None:
    samples = [sample(float(t_s), x_m=10.0 * i, v_m_s=3.0) for i, t_s in enumerate(np.cumsum(steps_s))]
    track = track_of(*samples)
    for one in samples[-KEPT:]:
        assert track.at(one.t_s)[0] == pytest.approx(one.position_m)


def test_before_all_it_stands_at_the_oldest_and_after_all_it_flies_on_and_then_stands() -> None:
    track = track_of(sample(10.0, x_m=100.0, v_m_s=20.0), sample(11.0, x_m=120.0, v_m_s=20.0))
    assert track.at(0.0)[0][0] == 100.0
    assert track.at(11.5)[0][0] == pytest.approx(130.0)
    assert track.at(11.0 + AHEAD_S)[0] == pytest.approx(track.at(1000.0)[0])
    assert track.at(1000.0)[0][0] == pytest.approx(120.0 + 20.0 * AHEAD_S)


def test_what_comes_late_or_twice_is_left_out() -> None:
    track = track_of(sample(1.0, x_m=1.0), sample(3.0, x_m=3.0), sample(2.0, x_m=99.0), sample(3.0, x_m=99.0))
    assert track.newest_s == 3.0
    assert track.at(3.0)[0][0] == 3.0
    assert track.trail(np.array([1.0, 2.0, 3.0]))[:, 0].tolist() == [1.0, 2.0, 3.0]


def test_of_who_has_said_nothing_nothing_is_known() -> None:
    track = track_of(sample(5.0))
    track.clear()
    for one in (Track(), track):
        assert one.newest_s == -math.inf
        assert np.isnan(one.at(1.0)).all()
        assert np.isnan(one.trail(np.array([0.0, 1.0]))).all()


def test_a_trail_is_the_way_that_was_flown_and_unknown_before_its_begin() -> None:
    track = track_of(*(sample(float(t_s), x_m=float(t_s**2)) for t_s in range(5)))
    trail = track.trail(np.array([-1.0, 0.0, 2.0, 3.5, 4.0]))
    assert np.isnan(trail[0]).all()
    assert trail[1:, 0].tolist() == [0.0, 4.0, 12.5, 16.0]


def test_a_long_flight_keeps_its_newest_places() -> None:
    track = track_of(*(sample(float(t_s), x_m=float(t_s)) for t_s in range(2 * TRAIL + 100)))
    trail = track.trail(np.array([TRAIL - 1.0, TRAIL, 2.0 * TRAIL + 99.0]))
    assert np.isnan(trail[0]).all()
    assert trail[1:, 0].tolist() == [TRAIL, 2.0 * TRAIL + 99.0]
