"""What is true of the window of requests, whatever comes in whatever order."""

import math
import random
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from sitl.services.request_window import MAX_OUTSTANDING, UNMEASURED, Order, RequestWindow


class Clock:
    def __init__(self) -> None:
        self.time_s = 0.0

    def __call__(self) -> float:
        return self.time_s


def step(window: RequestWindow, seq: int) -> list[int]:
    window.receive(seq)
    return window.requests()


def test_it_probes_with_a_gap_that_a_strict_station_cannot_close() -> None:
    window = RequestWindow(0, 30, Clock())
    assert window.requests() == [4, 3, 2, 0]
    assert step(window, 0) == [5, 4, 3, 1]
    assert window.order is Order.UNKNOWN


def test_a_station_that_answers_ahead_is_asked_for_a_window_at_a_time() -> None:
    window = RequestWindow(0, 200, Clock())
    waiting = window.requests()
    widths = []
    while waiting:
        waiting += step(window, waiting.pop(0))
        widths.append(len(window.outstanding))
    assert window.complete
    assert widths[0] == max(widths) == MAX_OUTSTANDING


def test_a_station_that_never_answers_ahead_is_asked_for_one_at_a_time() -> None:
    window = RequestWindow(0, 30, Clock())
    window.requests()
    asked = [step(window, seq) for seq in range(30)]
    assert [len(seqs) for seqs in asked] == [4, 4] + [1] * 28
    assert window.order is Order.STRICT


def test_one_that_only_seemed_strict_is_given_the_window_after_all() -> None:
    window = RequestWindow(0, 30, Clock())
    window.requests()
    for seq in range(3):
        step(window, seq)
    assert window.order is Order.STRICT
    step(window, 6)
    assert window.order is Order.ANY


def test_one_that_has_complained_is_not() -> None:
    window = RequestWindow(0, 30, Clock())
    window.requests()
    step(window, 0)
    window.fall_back()
    assert window.requests() == [1]
    assert step(window, 4) == []
    assert window.order is Order.STRICT
    assert step(window, 1) == [2]


def test_only_what_is_overdue_is_asked_for_again() -> None:
    clock = Clock()
    window = RequestWindow(0, 60, clock)
    window.requests()
    for seq in (0, 5):
        clock.time_s += 0.1
        window.requests()
        step(window, seq)
    later = window.outstanding - {1, 3, 4}
    step(window, 3)
    clock.time_s = window.deadline_s
    assert later
    assert set(window.requests()) == {1, 4}
    assert window.requests() == []


def test_the_last_item_is_asked_for_when_all_others_are_in() -> None:
    window = RequestWindow(4, 20, Clock())
    waiting = window.requests()
    while waiting:
        assert 20 not in waiting or window.lowest == 20
        waiting += step(window, waiting.pop())
    assert window.complete


class GoesBack:
    """Answers the item it expects, or an earlier one, after which it expects the next to that."""

    expected = 0

    def __call__(self, seq: int) -> bool:
        if seq > self.expected:
            return False
        self.expected = seq + 1
        return True


def test_a_strict_station_that_has_gone_back_is_fetched() -> None:
    clock, station = Clock(), GoesBack()
    window = RequestWindow(0, 30, clock, strict=True)
    asked, fetched = window.requests(), False
    while not window.complete:
        assert clock.time_s < 60.0
        for seq in asked:
            if station(seq):
                window.receive(seq)
        if window.lowest == 20 and not fetched:
            station.expected, fetched = 18, True
        asked = window.requests()
        if not asked:
            clock.time_s = window.deadline_s
            asked = window.requests()
    assert station.expected == 31


@settings(max_examples=200, deadline=None)
@given(st.data())
def test_it_asks_for_what_is_missing_and_ends_whatever_comes(data: Any) -> None:
    first = data.draw(st.integers(0, 5))
    last = data.draw(st.integers(first, first + 50))
    clock = Clock()
    window = RequestWindow(first, last, clock, strict=data.draw(st.booleans()))
    in_flight = window.requests()
    held: set[int] = set()
    for choice in data.draw(st.lists(st.integers(0, 99), max_size=60)):
        if choice < 70 and in_flight:
            seq = in_flight[choice % len(in_flight)] if choice % 3 else in_flight.pop(choice % len(in_flight))
            assert window.wants(seq) or seq in held
            held.add(seq)
            window.receive(seq)
        elif choice < 75:
            window.fall_back()
        elif choice < 80:
            in_flight += window.ask_again()
        else:
            clock.time_s += choice / 200
        in_flight += window.requests()
        assert window.complete == (held == set(range(first, last + 1)))
        assert len(window.outstanding) <= MAX_OUTSTANDING
        assert all(first <= seq <= last for seq in in_flight)
        assert window.complete or (window.outstanding and math.isfinite(window.deadline_s))
    for _ in range(500):
        clock.time_s = max(clock.time_s, window.deadline_s)
        for seq in window.requests() if not window.complete else []:
            window.receive(seq)
        if window.complete:
            break
    assert window.complete


def opened(clock: Clock, last: int = 200) -> tuple[RequestWindow, list[int]]:
    """A window that is open and full, with a round trip of 0.1 s, and what has been asked for and has not come."""
    window = RequestWindow(0, last, clock)
    asked = window.requests()
    clock.time_s += 0.1
    for seq in asked:
        window.receive(seq)
    return window, window.requests()


def test_what_later_answers_have_overtaken_is_asked_for_before_it_is_overdue() -> None:
    clock = Clock()
    window, asked = opened(clock)
    clock.time_s += 0.1
    assert [asked[0] in step(window, seq) for seq in asked[1:4]] == [False, False, True]


def test_before_a_round_trip_is_known_little_is_asked_for() -> None:
    clock = Clock()
    window = RequestWindow(0, 200, clock)
    window.requests()
    clock.time_s = window.deadline_s
    asked = window.requests()
    for seq in asked:
        window.receive(seq)
    window.requests()
    assert window.order is Order.ANY
    assert len(window.outstanding) == UNMEASURED


@pytest.mark.parametrize("loss", [0.0, 0.1, 0.4])
def test_no_more_than_a_window_is_ever_on_its_way_copies_included(loss: float) -> None:
    chance, clock = random.Random(1), Clock()
    window, asked = opened(clock)
    sent, on_the_way = 0, [(clock.time_s + 0.1, seq) for seq in asked]
    while not window.complete:
        clock.time_s = min([due_s for due_s, _ in on_the_way] + [max(clock.time_s, window.deadline_s)])
        here = [seq for due_s, seq in on_the_way if due_s <= clock.time_s]
        on_the_way = [(due_s, seq) for due_s, seq in on_the_way if due_s > clock.time_s]
        for seq in here:
            if chance.random() >= loss:
                window.receive(seq)
        new = window.requests()
        sent += len(new)
        on_the_way += [(clock.time_s + 0.1, seq) for seq in new]
        # what was repeated because it was overtaken may still be on its way, as its answer is lost
        assert len(on_the_way) <= MAX_OUTSTANDING * (2 if loss else 1)
    assert sent <= 200 * (1.0 if loss == 0.0 else 1.0 + 3.0 * loss)
