"""Samples that come when they come: on a fast network as in lockstep, on a slow one later by what it takes."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from sitl.formation.arrivals import Arrivals
from sitl.formation.channel import DRAWS, Channel
from sitl.formation.correction import Correction
from sitl.formation.law import Gains
from sitl.formation.link import Link
from sitl.noise import uniforms
from sitl.ticks import TICK_S

GAINS = Gains(0.2, 0.8, 0.4, 0.01)
TICKS = 300


def sample(tick: int) -> Correction:
    return Correction(2, tick, tick, True, 0.1 * tick, -0.2)


def link(channel: Channel) -> Arrivals:
    return Arrivals(channel, None if channel.certain else uniforms(7, 2, 1, DRAWS), ())


@given(st.lists(st.floats(0.0, 0.99), min_size=20, max_size=20), st.integers(1, 6))
def test_on_a_network_that_takes_less_than_a_tick_samples_count_when_they_would_in_lockstep(
    took: list[float], delay_ticks: int
) -> None:
    arrivals = link(Channel(delay_ticks))
    for tick, took_ticks in enumerate(took):
        arrivals.arrive(sample(tick), tick + took_ticks)
        expected = sample(tick - delay_ticks) if tick >= delay_ticks else None
        assert arrivals.newest(tick) == expected
    assert (arrivals.heard, arrivals.late, arrivals.lost) == (20, 0, 0)


@given(st.lists(st.floats(0.0, 9.0), min_size=20, max_size=20), st.integers(1, 6))
def test_the_injected_delay_comes_on_top_of_the_real_one(took: list[float], delay_ticks: int) -> None:
    arrivals = link(Channel(delay_ticks))
    coming = sorted((tick + took_ticks, tick) for tick, took_ticks in enumerate(took))
    in_order = [(at, tick) for i, (at, tick) in enumerate(coming) if all(tick > before for _, before in coming[:i])]
    for at, tick in in_order:
        arrivals.arrive(sample(tick), at)
    real = [at - tick for at, tick in in_order]
    assert arrivals.late == sum(ticks >= 1.0 for ticks in real)
    assert arrivals.delay_max_s == pytest.approx((max(real) + delay_ticks) * TICK_S)
    assert arrivals.delay_mean_s == pytest.approx((sum(real) / len(real) + delay_ticks) * TICK_S)
    for tick in range(40):
        if (newest := arrivals.newest(tick)) is not None:
            assert newest.tick <= tick - delay_ticks, "never younger than the delay"


@given(st.sets(st.integers(1, 50)))
def test_gaps_in_the_sequence_are_counted(missing: set[int]) -> None:
    arrivals = link(Channel(1))
    for tick in range(52):
        if tick not in missing:
            arrivals.arrive(sample(tick), tick)
    assert (arrivals.lost, arrivals.heard) == (len(missing), 52 - len(missing))


def test_what_comes_twice_counts_once() -> None:
    arrivals = link(Channel(1))
    for _ in range(3):
        arrivals.arrive(sample(5), 5.0)
    assert (arrivals.heard, arrivals.lost) == (1, 0)


def test_the_channels_model_does_to_each_sample_what_it_does_in_lockstep() -> None:
    channel = Channel(3, jitter_ticks=4, loss=0.2, enter=0.05, leave=0.3)
    lockstep = Link(channel, uniforms(7, 2, 1, DRAWS), (), 50, 1.0)
    arrivals, newest = link(channel), -1
    own = [Correction(1, 0, 0, True, 0.0, 0.0)]
    for tick in range(TICKS):
        arrivals.arrive(sample(tick), tick + 0.3)
        if (heard := arrivals.newest(tick)) is not None:
            newest = max(newest, heard.tick)
        lockstep.hear(tick, sample(tick - 3) if tick >= 3 else None)
        lockstep.part(tick, own, 1.0, GAINS)
        assert newest == lockstep._newest


def test_a_silence_of_the_scenario_takes_samples_away_and_is_no_loss_of_the_network() -> None:
    arrivals = Arrivals(Channel(1), None, [(10, 20)])
    heard = []
    for tick in range(40):
        arrivals.arrive(sample(tick), tick)
        if (newest := arrivals.newest(tick)) is not None:
            heard.append(newest.tick)
    assert heard == [*range(10), *range(20, 39)]
    assert arrivals.lost == 0
