"""What a scheduled failure silences."""

import pytest

from sitl.formation.failures import FOR_EVER, Failure, death_tick, frozen, silences, within

KILL = Failure("kill", frozenset({2}), (), (100, FOR_EVER))
FREEZE = Failure("freeze", frozenset({3}), (), (10, 20))
SILENCE = Failure("silence", frozenset(), (), (50, 60))
SPLIT = Failure("split", frozenset(), (frozenset({1, 2}), frozenset({3})), (30, 40))
ALL = (KILL, FREEZE, SILENCE, SPLIT)


@pytest.mark.parametrize(
    ("sender", "receiver", "intervals"),
    [
        (1, 2, [(50, 60)]),
        (2, 1, [(50, 60), (100, FOR_EVER)]),
        (1, 3, [(10, 20), (30, 40), (50, 60)]),
        (3, 1, [(10, 20), (30, 40), (50, 60)]),
        (4, 5, [(50, 60)]),
        (4, 1, [(30, 40), (50, 60)]),
    ],
)
def test_who_does_not_hear_whom_and_when(sender: int, receiver: int, intervals: list[tuple[int, int]]) -> None:
    assert silences(sender, receiver, ALL) == intervals


def test_the_dead_stay_dead_and_the_first_kill_counts() -> None:
    again = Failure("kill", frozenset({2}), (), (200, FOR_EVER))
    assert death_tick(2, (again, KILL)) == 100
    assert death_tick(1, ALL) == FOR_EVER
    assert frozen(3, ALL) == [(10, 20)]


def test_an_interval_holds_its_first_tick_and_not_its_last() -> None:
    assert [within(tick, [(10, 20), (15, 30)]) for tick in (9, 10, 19, 29, 30)] == [False, True, True, True, False]
    assert not within(0, [])
