import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from gcs.metrics.shape import shape

T_S = np.arange(5.0)
EAST = (1.0, 0.0)


def line(speed_m_s: float, y_m: float, x0_m: float = 0.0) -> np.ndarray:
    """(5, 3) positions of one vehicle on its way east."""
    return np.column_stack([x0_m + speed_m_s * T_S, np.full(5, y_m), np.zeros(5)])


def test_a_leader_that_overtakes_leads_from_then_on() -> None:
    found = shape(np.array([line(30.0, 0.0), line(20.0, 100.0, 15.0), line(20.0, -100.0)]), T_S, EAST)
    assert found.lead_from_s == 2.0
    assert found.gap_max_m == pytest.approx(np.hypot(200.0, 15.0))


def test_a_leader_that_is_passed_does_not_lead() -> None:
    assert shape(np.array([line(20.0, 0.0), line(30.0, 100.0)]), T_S, EAST).lead_from_s is None


def test_one_follower_has_nobody_beside_it() -> None:
    found = shape(np.array([line(30.0, 0.0), line(20.0, 100.0)]), T_S, EAST)
    assert (found.gap_min_m, found.gap_max_m) == (None, None)


def test_what_happens_after_somebody_has_landed_does_not_count() -> None:
    passed = line(20.0, 100.0)
    passed[3:, 0] += 1000.0
    leader = line(30.0, 0.0, 1.0)
    leader[3:] = np.nan
    assert shape(np.array([leader, passed]), T_S, EAST).lead_from_s == 0.0


@given(st.permutations(range(1, 6)))
def test_neighbours_are_those_that_start_beside_each_other_in_whatever_order(order: list[int]) -> None:
    followers = [line(20.0, 2000.0 * place) for place in order]
    found = shape(np.array([line(30.0, 0.0), *followers]), T_S, EAST)
    assert found.gap_min_m == found.gap_max_m == 2000.0
    assert found.gap_change == 0.0


def test_a_gap_is_measured_against_what_it_was_at_the_start() -> None:
    far = [line(30.0, 0.0, 9.0), line(20.0, 400.0), line(20.0, 0.0)]
    near = line(20.0, 100.0)
    near[4, 1] = 50.0
    found = shape(np.array([*far, near]), T_S, EAST)
    assert found.gap_change == 0.5
    assert (found.gap_min_m, found.gap_max_m) == (50.0, 350.0)
