"""Who gives way: of any two that can, exactly one; and those that cannot never."""

from hypothesis import given
from hypothesis import strategies as st

from sitl.avoidance.intent import GROUNDED, KEEPS, PERIOD_TICKS, QUIET, YIELDS
from sitl.avoidance.rule import LOST_S, NEVER, Known, has_right_of_way
from sitl.ticks import TICK_S

NOW = 40 * PERIOD_TICKS
rows = st.integers(0, 8)


def known(status: int, stamp: int) -> Known:
    return Known([stamp] * 9, [status] * 9, [1.0] * 9, [2] * 9, [()] * 9)


@given(rows, rows)
def test_of_two_that_can_give_way_the_one_with_the_larger_system_id_does(one: int, other: int) -> None:
    fresh = known(YIELDS, NOW - PERIOD_TICKS)
    assert has_right_of_way(other, one, NOW, fresh) == (other < one)
    assert has_right_of_way(one, other, NOW, fresh) == (one < other)


@given(rows, rows)
def test_who_cannot_or_is_not_heard_is_given_way_to_by_everyone(one: int, other: int) -> None:
    apart = one != other
    assert has_right_of_way(other, one, NOW, known(KEEPS, NOW - PERIOD_TICKS)) == apart
    lost = NOW - round(LOST_S / TICK_S) - PERIOD_TICKS
    assert has_right_of_way(other, one, NOW, known(YIELDS, lost)) == apart


@given(rows, rows)
def test_nobody_gives_way_to_who_is_on_the_ground_or_has_told_nothing(one: int, other: int) -> None:
    assert not has_right_of_way(other, one, NOW, known(GROUNDED, NOW))
    assert not has_right_of_way(other, one, NOW, known(QUIET, NEVER))
