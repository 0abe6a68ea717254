"""What is true of the time-outs."""

import pytest

from sitl.services.round_trip import GRANULARITY_S, INITIAL_S, LONGEST_S, SHORTEST_S, RoundTrip


def test_the_first_is_the_guides() -> None:
    assert RoundTrip().timeout_s(0) == INITIAL_S


def test_a_quick_link_gets_the_shortest_and_a_slow_one_what_it_takes() -> None:
    quick, slow = RoundTrip(), RoundTrip()
    for _ in range(50):
        quick.measure(0.001)
        slow.measure(0.8)
    assert quick.timeout_s(0) == SHORTEST_S
    assert slow.timeout_s(0) == pytest.approx(0.8 + GRANULARITY_S, rel=0.01)


def test_a_shaky_link_gets_more_than_its_mean() -> None:
    shaky = RoundTrip()
    for seconds in (0.1, 0.9) * 20:
        shaky.measure(seconds)
    assert shaky.timeout_s(0) > 0.9


def test_it_doubles_with_each_try_up_to_a_limit() -> None:
    trip = RoundTrip()
    trip.measure(0.1)
    waits = [trip.timeout_s(tries) for tries in range(6)]
    assert waits[1] == 2 * waits[0]
    assert waits[-1] == LONGEST_S


def test_a_link_slower_than_the_limit_gets_what_it_takes() -> None:
    trip = RoundTrip()
    for _ in range(50):
        trip.measure(5.0)
    assert trip.timeout_s(0) > LONGEST_S
