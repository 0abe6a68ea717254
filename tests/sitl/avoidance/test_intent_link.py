"""What comes through a link of intents: by sequence number, never by order of arrival; bursts as samples meet them."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from sitl.avoidance.intent import PERIOD_TICKS, QUIET, YIELDS, Intent, intent_at
from sitl.avoidance.intent_link import IntentLink, channel_of_intents
from sitl.formation.channel import DRAWS, Channel, carried
from sitl.noise import Stream, uniforms

LOSSY = Channel(5, 40, 0.3, 0.05, 0.2)


def told(k: int, status: int = YIELDS) -> Intent:
    return intent_at(1, k * PERIOD_TICKS, status)


def link(channel: Channel = LOSSY) -> IntentLink:
    draws = None if channel.certain else uniforms(1, 1, 2, DRAWS, Stream.INTENTS)
    return IntentLink(channel, draws, [(1000, 2000)])


@settings(max_examples=30, deadline=None)
@given(st.sets(st.integers(0, 11)))
def test_what_becomes_of_an_intent_does_not_depend_on_which_others_come(came: set[int]) -> None:
    due = {}
    for k in came:
        alone = link()
        alone.arrive(told(k))
        due[k] = next((tick for tick in range(400) if alone.newer(tick) is not None), 400)
    together = link()
    for k in sorted(came):
        together.arrive(told(k))
    newest = -1
    for tick in range(400):
        if (intent := together.newer(tick)) is not None:
            newest = intent.sequence
        assert newest == max((k for k in came if due[k] <= tick), default=-1)


def test_it_counts_after_the_delay_and_what_is_silenced_or_quiet_never() -> None:
    one = link(Channel(5))
    for k, status in ((0, YIELDS), (1, QUIET), (40, YIELDS), (80, YIELDS)):
        one.arrive(told(k, status))
    heard = {tick: intent.tick for tick in range(2100) if (intent := one.newer(tick)) is not None}
    assert heard == {5: 0, 2005: 2000}


def test_on_a_network_that_takes_its_time_the_delay_comes_on_top() -> None:
    one = link(Channel(5))
    one.arrive(told(0), took_ticks=7)
    assert [tick for tick in range(20) if one.newer(tick) is not None] == [12]


@pytest.mark.parametrize("in_burst", [False, True])
def test_a_burst_lasts_over_intents_as_over_samples(in_burst: bool) -> None:
    """The chance to be in a burst a period later, against the samples between."""
    channel = Channel(1, enter=0.01, leave=0.03)
    rng = np.random.default_rng(1)
    ends = 0
    for _ in range(4000):
        state = in_burst
        for draw in rng.random((PERIOD_TICKS, DRAWS)).tolist():
            state, _ = carried(state, tuple(draw), channel)
        ends += state
    rare = channel_of_intents(channel)
    assert ends / 4000 == pytest.approx(1.0 - rare.leave if in_burst else rare.enter, abs=0.03)
