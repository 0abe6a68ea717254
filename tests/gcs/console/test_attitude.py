"""How an aircraft lies in the air: quaternions w, x, y, z of roll, pitch and heading."""

import math

import numpy as np
import numpy.typing as npt
import pytest
from hypothesis import given
from hypothesis import strategies as st
from viser.transforms import SO3

from gcs.console.attitude import quaternions

FloatArray = npt.NDArray[np.float64]
HALF = math.sqrt(0.5)
turns = st.floats(-math.pi, math.pi)
attitudes = st.tuples(turns, st.floats(-1.5, 1.5), turns)


def turned(attitude_rad: tuple[float, float, float], body: tuple[float, float, float]) -> FloatArray:
    """Where an axis of the body points, by the library that draws it."""
    (wxyz,) = quaternions(np.array([attitude_rad]))
    return np.asarray(SO3(wxyz).apply(np.array(body)))


@pytest.mark.parametrize(
    ("attitude_rad", "wxyz"),
    [
        ((0.0, 0.0, 0.0), (1.0, 0.0, 0.0, 0.0)),
        ((0.0, 0.0, math.pi / 2.0), (HALF, 0.0, 0.0, HALF)),
        ((0.0, math.pi / 2.0, 0.0), (HALF, 0.0, -HALF, 0.0)),
        ((math.pi / 2.0, 0.0, 0.0), (HALF, HALF, 0.0, 0.0)),
    ],
    ids=["level, east", "level, north", "straight up", "on its right wing"],
)
def test_known_attitudes(attitude_rad: tuple[float, ...], wxyz: tuple[float, ...]) -> None:
    assert quaternions(np.array([attitude_rad]))[0] == pytest.approx(wxyz)


@given(attitudes)
def test_the_nose_points_where_heading_and_pitch_say(attitude_rad: tuple[float, float, float]) -> None:
    _, pitch, heading = attitude_rad
    nose = (math.cos(pitch) * math.cos(heading), math.cos(pitch) * math.sin(heading), math.sin(pitch))
    assert turned(attitude_rad, (1.0, 0.0, 0.0)) == pytest.approx(nose, abs=1e-12)


@given(attitudes)
def test_a_roll_to_the_right_lifts_the_left_wing(attitude_rad: tuple[float, float, float]) -> None:
    roll, pitch, _ = attitude_rad
    left_wing = turned(attitude_rad, (0.0, 1.0, 0.0))
    assert left_wing[2] == pytest.approx(math.sin(roll) * math.cos(pitch), abs=1e-12)


@given(st.lists(attitudes, min_size=1, max_size=20))
def test_all_are_of_unit_length_and_in_the_order_of_the_vehicles(attitudes_rad: list[tuple[float, ...]]) -> None:
    found = quaternions(np.array(attitudes_rad))
    assert np.linalg.norm(found, axis=1) == pytest.approx(np.ones(len(attitudes_rad)))
    assert found[-1] == pytest.approx(quaternions(np.array(attitudes_rad[-1:]))[0])


def test_who_is_not_known_lies_level() -> None:
    assert quaternions(np.full((1, 3), np.nan)).tolist() == [[1.0, 0.0, 0.0, 0.0]]
