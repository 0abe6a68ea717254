"""The law (15) on along-track deviations: consensus without a leader, pinned to the schedule."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from sitl.formation.law import Gains, correction, formation_acceleration
from sitl.guidance.path_errors import PathErrors

GAINS = Gains(0.2, 0.8, 0.4, 0.01)
ON_TIME = PathErrors(0, 0, 0, 0, 25, 0, 0, 0, 0, 0, 0)
deviation = st.floats(-50, 50)


@given(deviation, deviation, deviation, deviation)
def test_what_one_gives_the_other_takes(e: float, e_rate: float, other: float, other_rate: float) -> None:
    """Symmetric weights: the corrections of a pair add up to nothing, so the mean deviation is not moved by them."""
    there = correction(e, e_rate, other, other_rate, 0.5, GAINS)
    back = correction(other, other_rate, e, e_rate, 0.5, GAINS)
    assert there + back == pytest.approx(0, abs=1e-9)


def test_equal_deviations_need_no_correction() -> None:
    assert correction(7, -1, 7, -1, 0.5, GAINS) == 0


def test_on_time_it_follows_the_schedules_acceleration() -> None:
    assert formation_acceleration(ON_TIME._replace(reference_acceleration=0.2), 0, GAINS) == 0.2


@given(st.floats(-1e5, 1e5), st.floats(-1e5, 1e5))
def test_corrections_and_pin_are_clipped_at_2_m_s2_each(along: float, corrections: float) -> None:
    wanted = formation_acceleration(ON_TIME._replace(along=along), corrections, GAINS)
    assert abs(wanted) <= 4.0


def test_who_is_late_hurries() -> None:
    assert formation_acceleration(ON_TIME._replace(along=-10), 0, GAINS) == pytest.approx(0.1)
    assert formation_acceleration(ON_TIME._replace(along_rate=-1), 0, GAINS) == pytest.approx(0.4)
