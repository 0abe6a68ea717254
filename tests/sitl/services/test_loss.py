"""What is learned of a link from what had to be asked again."""

import random

from hypothesis import given
from hypothesis import strategies as st

from sitl.services.loss import MOST_COPIES, Loss, learn
from sitl.services.round_trip import RoundTrip


@given(st.lists(st.booleans()))
def test_copies_are_few_and_one_on_a_good_link(answers: list[bool]) -> None:
    loss = Loss()
    for lost in answers:
        loss.measure(lost=lost)
        assert 0.0 <= loss.part <= 1.0
        assert 1 <= loss.copies <= MOST_COPIES
    for _ in range(50):
        loss.measure(lost=False)
    assert loss.copies == 1


def test_it_finds_what_is_lost_and_sends_more_the_more_that_is() -> None:
    copies = []
    for part in (0.0, 0.2, 0.5, 0.8):
        chance, loss, seen = random.Random(1), Loss(), []
        for _ in range(2000):
            loss.measure(lost=chance.random() < part)
            seen.append(loss.part)
        assert abs(sum(seen[100:]) / len(seen[100:]) - part) < 0.03
        loss.part = part
        copies.append(loss.copies)
    assert copies == [1, 2, MOST_COPIES, MOST_COPIES]


def test_an_answer_to_a_repeat_tells_of_loss_only_if_it_cannot_be_one_to_the_question_before() -> None:
    round_trip, loss = RoundTrip(), Loss()
    assert not learn(round_trip, loss, 0.1, 0.9)
    assert (round_trip.smoothed_s, loss.part) == (None, 0.0)
    assert learn(round_trip, loss, 0.4)
    assert not learn(round_trip, loss, 0.1, 0.9)
    assert loss.part == 0.0
    assert round_trip.smoothed_s is not None
    assert round_trip.smoothed_s > 0.4
    assert learn(round_trip, loss, 0.4, 0.9)
    assert loss.part > 0.0
