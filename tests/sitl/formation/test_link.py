"""A link at its receiver: which sample counts, and how much."""

import itertools
from collections import deque
from collections.abc import Sequence

import pytest

from sitl.formation.channel import Channel
from sitl.formation.correction import Correction
from sitl.formation.law import Gains, correction
from sitl.formation.link import FADE_S, NEVER, Link, arrive, newest_heard
from sitl.ticks import TICK_S

GAINS = Gains(0.2, 0.8, 0.4, 0.01)
DELAY, STALE = 2, 5


def sample(sysid: int, tick: int, along: float = 0.0, *, flying: bool = True) -> Correction:
    return Correction(sysid, tick, tick, flying, along, 0.0)


class Ear:
    """A link that is heard tick by tick; the own deviation is 0, the neighbour's its tick."""

    def __init__(self, silences: Sequence[tuple[int, int]] = (), stale_ticks: int = STALE) -> None:
        self.link = Link(Channel(DELAY), None, silences, stale_ticks, trust=1.0)
        self.own: deque[Correction] = deque(maxlen=50)
        self.tick = 0

    def hear(self, *, said: bool = True, flying: bool = True, weight: float = 1.0) -> float:
        self.own.append(sample(1, self.tick))
        stamp = self.tick - DELAY
        self.link.hear(self.tick, sample(2, stamp, along=stamp, flying=flying) if said and stamp >= 0 else None)
        part = self.link.part(self.tick, self.own, weight, GAINS)
        self.tick += 1
        return part


def test_the_newest_sample_counts_against_the_own_deviation_of_its_tick() -> None:
    ear = Ear()
    parts = [ear.hear() for _ in range(10)]
    assert parts == [0.0, 0.0] + [correction(0.0, 0.0, stamp, 0.0, 1.0, GAINS) for stamp in range(8)]


def test_it_is_held_until_it_is_too_old_then_the_edge_is_dropped() -> None:
    ear = Ear()
    for _ in range(10):
        ear.hear()
    held = [ear.hear(said=False) for _ in range(STALE + 3)]
    assert held[:STALE] == [correction(0.0, 0.0, 7.0, 0.0, 1.0, GAINS)] * STALE
    assert held[STALE:] == [0.0] * 3
    assert ear.link.trust == 0.0


def test_an_edge_that_is_back_gains_its_weight_slowly() -> None:
    ear = Ear()
    for _ in range(20):
        ear.hear(said=False)
    assert ear.link.trust == 0.0
    trusts = []
    for _ in range(round(FADE_S / TICK_S) + 1):
        ear.hear()
        trusts.append(ear.link.trust)
    assert trusts[0] == pytest.approx(TICK_S / FADE_S)
    assert max(b - a for a, b in itertools.pairwise(trusts)) < 1.01 * TICK_S / FADE_S
    assert trusts[-1] == 1.0


@pytest.mark.parametrize("change", [{"flying": False}, {"weight": 0.0}])
def test_who_does_not_fly_its_schedule_or_is_no_neighbour_does_not_count(change: dict[str, bool]) -> None:
    ear = Ear()
    for _ in range(5):
        ear.hear()
    assert ear.hear(**change) == 0.0  # type: ignore[arg-type]
    assert not ear.link.used


def test_nothing_comes_through_in_a_silence_by_the_senders_ticks() -> None:
    ear = Ear(silences=[(3, 6)], stale_ticks=50)
    parts = [ear.hear() for _ in range(12)]
    assert parts[DELAY + 3 : DELAY + 6] == [parts[DELAY + 2]] * 3
    assert parts[DELAY + 6] > parts[DELAY + 2]


def test_of_samples_that_overtake_each_other_the_newest_stays() -> None:
    arrivals = [NEVER] * 4
    arrive(10, 13, arrivals)
    arrive(11, 12, arrivals)
    newest = newest_heard(12, 9, arrivals)
    assert newest == 11
    assert newest_heard(13, newest, arrivals) == 11
    assert arrivals == [NEVER] * 4
