"""The law as airspeeds: what agreement, lateness and neighbours ask for."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from gcs.companion.speed_law import CATCH_UP_M_S, speed_over_ground_m_s

metres = st.floats(-1e4, 1e4)
neighbours = st.lists(st.tuples(st.floats(0.0, 0.5), metres), max_size=2)


@given(st.floats(15.0, 40.0), metres)
def test_who_is_on_schedule_with_all_neighbours_flies_as_scheduled(scheduled_m_s: float, along_m: float) -> None:
    assert speed_over_ground_m_s(scheduled_m_s, 0.0, [(0.5, 0.0), (0.5, 0.0)]) == scheduled_m_s
    asked = speed_over_ground_m_s(scheduled_m_s, along_m, [(0.5, along_m)])
    assert (asked - scheduled_m_s) * along_m <= 0.0


@given(metres, neighbours)
def test_corrections_are_bounded_and_odd(along_m: float, near: list[tuple[float, float]]) -> None:
    faster = speed_over_ground_m_s(0.0, along_m, near)
    slower = speed_over_ground_m_s(0.0, -along_m, [(weight, -other) for weight, other in near])
    assert abs(faster) <= CATCH_UP_M_S
    assert faster == pytest.approx(-slower)


def test_neighbours_that_are_late_hold_a_vehicle_back() -> None:
    assert speed_over_ground_m_s(25.0, 0.0, [(0.5, -20.0), (0.5, -20.0)]) < 25.0
    assert speed_over_ground_m_s(25.0, 0.0, [(0.5, 20.0)]) > 25.0
