"""The path law feeds forward turns, brings errors back, and its limits hold."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from missions.airframe import GRAVITY_M_S2
from missions.scenario import load_scenario
from sitl.guidance.path_errors import PathErrors
from sitl.guidance.path_law import Accelerations, across_acceleration, limited, up_acceleration

AIRFRAME = load_scenario("radars").airframe.airframe()
ON_PATH = PathErrors(0, 0, 0, 0, 25, 0, 0, 0, 0, 0, 0)


def test_on_the_path_only_the_turn_is_fed_forward() -> None:
    assert across_acceleration(ON_PATH._replace(curvature=1 / 250)) == pytest.approx(2.5)
    assert across_acceleration(ON_PATH) == 0


@given(st.floats(0.1, 1000))
def test_errors_are_answered_from_the_other_side(error: float) -> None:
    assert (
        across_acceleration(ON_PATH._replace(across=error)) < 0 < across_acceleration(ON_PATH._replace(across=-error))
    )
    assert up_acceleration(error, 0, 0) < 0 < up_acceleration(-error, 0, 0)


def test_a_far_path_is_met_at_an_angle_not_head_on() -> None:
    settled = 0.16 * 60 / 0.6
    assert across_acceleration(ON_PATH._replace(across=1e4, v_n=-settled)) == pytest.approx(0)


@given(st.floats(-50, 50), st.floats(-50, 50), st.floats(-50, 50), st.floats(18, 36), st.floats(-4, 5))
def test_limits(ahead: float, left: float, up: float, airspeed: float, v_z: float) -> None:
    a = limited(Accelerations(ahead, left, up, 0.3), airspeed, v_z, AIRFRAME)
    assert 18.5 <= airspeed + a.ahead * 1.0 <= 36 or abs(a.ahead) < abs(ahead)
    assert a.ahead <= 36 - airspeed
    assert a.ahead >= 18.5 - airspeed
    assert abs(a.left) <= GRAVITY_M_S2 * 0.8391
    assert -4 <= a.up <= 6
    assert v_z + a.up <= 5 + 1e-9


def test_wishes_inside_the_limits_are_granted() -> None:
    wish = Accelerations(0.5, -2.0, 0.3, 1.0)
    assert limited(wish, 25, 0, AIRFRAME) == wish
