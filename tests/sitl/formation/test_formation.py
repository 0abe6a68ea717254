"""A vehicle's part in the formation, disturbed from a tick on: exactly as the same delay in the channel would be."""

import itertools
from collections import deque
from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from sitl.formation.channel import Channel
from sitl.formation.correction import Correction
from sitl.formation.disturbance import Disturbance
from sitl.formation.failures import FOR_EVER, Failure
from sitl.formation.formation import Formation
from sitl.formation.law import Gains
from sitl.formation.link import FADE_S
from sitl.formation.network import Network
from sitl.ticks import TICK_S

GAINS = Gains(0.2, 0.8, 0.4, 0.01)
CHANNEL = Channel(3)
LINE = Network((1, 2, 3), ((1, 2), (2, 3)), CHANNEL)


def said(sysid: int, tick: int) -> Correction:
    return Correction(sysid, tick, tick, True, 0.01 * (sysid * 7919 * tick % 1000), 0.3 * sysid, tick * 0.001 * sysid)


class Flown:
    """A formation that is stepped through ticks, with neighbours that always speak."""

    def __init__(self, sysid: int, network: Network, *, real_time: bool = False, clocked: bool = False) -> None:
        self.formation = Formation(sysid, network, 7, real_time=real_time, clocked=clocked)
        self.tick = 0
        self._sysid = sysid
        self._network = network
        self._own: deque[Correction] = deque(maxlen=self.formation.remembers_ticks)

    def corrections(self, ticks: int) -> list[float]:
        made = []
        for _ in range(ticks):
            self._own.append(said(self._sysid, self.tick))
            heard = {
                other: said(other, self.tick - delay)
                for other in self.formation.neighbours_at(self.tick)
                if self.tick >= (delay := self._network.channel_of(other, self._sysid).delay_ticks)
            }
            made.append(self.formation.corrections(self.tick, self._own, heard, GAINS))
            self.tick += 1
        return made

    def ages(self) -> list[int | None]:
        states = self.formation.link_states(self.tick - 1)
        return [None if state.age_s is None else round(state.age_s / TICK_S) for state in states]


@given(st.integers(1, 50), st.booleans())
def test_a_delay_that_is_added_is_a_delay_of_the_channel_bit_for_bit(delay_ticks: int, clocked: bool) -> None:
    disturbed = Flown(2, LINE, clocked=clocked)
    disturbed.formation.disturb(Disturbance(delay_ticks, 0.0, 0))
    slower = Flown(2, replace(LINE, channel=Channel(3 + delay_ticks)), clocked=clocked)
    assert disturbed.corrections(150) == slower.corrections(150)
    assert disturbed.formation.needs == slower.formation.needs


@pytest.mark.parametrize("channel", [CHANNEL, Channel(3, jitter_ticks=4, loss=0.2, enter=0.05, leave=0.3)])
@pytest.mark.parametrize("real_time", [False, True])
def test_it_counts_from_its_tick_until_the_next_and_the_channels_draws_stay(channel: Channel, real_time: bool) -> None:
    network = replace(LINE, channel=channel)
    calm, disturbed = Flown(2, network, real_time=real_time), Flown(2, network, real_time=real_time)
    disturbed.formation.disturb(Disturbance(0, 0.0, 100))
    disturbed.formation.disturb(Disturbance(20, 0.3, 60))  # told later, counts sooner
    before, while_ = disturbed.corrections(60), disturbed.corrections(40)
    assert disturbed.formation.disturbance == Disturbance(20, 0.3, 60)
    after = disturbed.corrections(60)
    assert calm.corrections(60) == before
    assert calm.corrections(40) != while_
    assert calm.corrections(60)[20:] == after[20:], "what was lost of the old is overtaken"


def test_the_same_disturbance_gives_the_same_flight_and_another_seed_of_link_another() -> None:
    def flown(sysid: int) -> list[float]:
        one = Flown(sysid, LINE)
        one.formation.disturb(Disturbance(4, 0.5, 20))
        return [float(age or 0) for _ in range(100) if one.corrections(1) for age in one.ages()]

    assert flown(1) == flown(1)
    assert flown(1) != flown(3), "both hear vehicle 2"


def test_ages_rise_by_a_tick_a_tick_to_what_was_added_and_fall_at_once() -> None:
    one = Flown(2, LINE)
    assert one.ages() == [None, None]
    one.corrections(30)
    assert one.ages() == [3, 3]
    one.formation.disturb(Disturbance(10, 0.0, one.tick))
    rising = [(one.corrections(1), one.ages()[0])[1] for _ in range(15)]
    assert rising == [*range(4, 13), *[13] * 6]
    one.formation.disturb(Disturbance(0, 0.0, one.tick))
    one.corrections(1)
    assert one.ages() == [3, 3]


@pytest.mark.parametrize("real_time", [False, True])
def test_ten_seconds_drop_the_edges_which_fade_in_again_afterwards(real_time: bool) -> None:
    one = Flown(2, LINE, real_time=real_time, clocked=True)
    one.corrections(100)
    assert [(state.used, state.trust) for state in one.formation.link_states(99)] == [(True, 1.0)] * 2
    one.formation.disturb(Disturbance(250, 0.0, one.tick))
    made = one.corrections(600)
    states = one.formation.link_states(one.tick - 1)
    assert [(state.sender, state.receiver, state.used, state.trust) for state in states] == [
        (1, 2, False, 0.0),
        (3, 2, False, 0.0),
    ]
    assert made[-1] == 0.0
    one.formation.disturb(Disturbance(0, 0.0, one.tick))
    trusts = [(one.corrections(1), one.formation.link_states(one.tick - 1)[0].trust)[1] for _ in range(300)]
    assert max(b - a for a, b in itertools.pairwise([0.0, *trusts])) < 1.01 * TICK_S / FADE_S
    assert trusts[-1] == 1.0
    assert one.formation.edges[-2:] == [(700, 1, True), (700, 3, True)]


def test_who_becomes_a_neighbour_while_it_is_disturbed_is_disturbed_too() -> None:
    kill = Failure("kill", frozenset({2}), (), (10, FOR_EVER))
    one = Flown(1, replace(LINE, failures=(kill,)))
    one.formation.lose({2})  # as if it had not been foreseen: 1 and 3 are neighbours now
    one.formation.disturb(Disturbance(20, 0.0, 5))
    one.corrections(100)
    assert one.ages()[1] == 23
    late = Flown(1, LINE)
    late.formation.disturb(Disturbance(20, 0.0, 5))
    late.corrections(50)
    late.formation.lose({2})
    late.corrections(50)
    assert late.ages()[1] == 23
