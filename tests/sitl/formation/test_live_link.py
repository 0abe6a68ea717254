"""The law in real time: as in lockstep while samples are punctual; older ones are carried on, then dropped."""

import itertools
from collections.abc import Sequence

import pytest
from hypothesis import given
from hypothesis import strategies as st

from sitl.formation.channel import Channel
from sitl.formation.correction import Correction
from sitl.formation.law import Gains, correction
from sitl.formation.link import FADE_S, Link
from sitl.formation.live_link import LiveLink
from sitl.ticks import TICK_S

GAINS = Gains(0.2, 0.8, 0.4, 0.01)
DELAY_TICKS, STALE_TICKS = 5, 50
CHANNEL = Channel(DELAY_TICKS)


def said(sysid: int, tick: int, along_m: float, rate_m_s: float = 0.0) -> Correction:
    return Correction(sysid, tick, tick, True, along_m, rate_m_s)


def live(trust: float = 1.0) -> LiveLink:
    return LiveLink(CHANNEL, None, (), STALE_TICKS, trust)


@given(st.lists(st.floats(-100, 100), min_size=30, max_size=30))
def test_punctual_samples_lead_to_what_they_lead_to_in_lockstep_bit_for_bit(along: list[float]) -> None:
    lockstep, link = Link(CHANNEL, None, (), STALE_TICKS, 1.0), live()
    own: list[Correction] = []
    for tick, along_m in enumerate(along):
        own.append(said(1, tick, -0.3 * along_m, 0.1))
        heard = said(2, tick - DELAY_TICKS, along[tick - DELAY_TICKS], 0.7) if tick >= DELAY_TICKS else None
        for one in (lockstep, link):
            one.hear(tick, heard)
        assert link.part(tick, own, 0.5, GAINS) == lockstep.part(tick, own, 0.5, GAINS)


def parts_after(last_stamp: int, until: int, rate_m_s: float) -> tuple[LiveLink, list[float]]:
    """A link whose neighbour fell silent, and what it added tick by tick."""
    link, own, parts = live(), [], []
    for tick in range(until + 1):
        own.append(said(1, tick, 0.0))
        stamp = tick - DELAY_TICKS
        link.hear(tick, said(2, stamp, rate_m_s * stamp * TICK_S, rate_m_s) if 0 <= stamp <= last_stamp else None)
        parts.append(link.part(tick, own, 1.0, GAINS))
    return link, parts


@pytest.mark.parametrize("age", [1, 10, STALE_TICKS])
def test_a_late_sample_is_carried_on_by_its_velocity_to_the_moment_that_is_due(age: int) -> None:
    last, rate = 40, 1.5
    tick = last + DELAY_TICKS + age
    link, parts = parts_after(last, tick, rate)
    assert link.used
    moment_s = (tick - DELAY_TICKS) * TICK_S
    assert parts[-1] == pytest.approx(correction(0.0, 0.0, rate * moment_s, rate, 1.0, GAINS))


def test_a_sample_that_is_too_old_is_ignored_and_a_new_one_fades_in() -> None:
    last = 40
    link, parts = parts_after(last, last + DELAY_TICKS + STALE_TICKS + 1, 1.5)
    assert not link.used
    assert parts[-1] == 0.0
    shares = back(link, start=last + DELAY_TICKS + STALE_TICKS + 2, ticks=round(FADE_S / TICK_S) + 2)
    assert shares[0] == 0.0
    assert max(b - a for a, b in itertools.pairwise(shares)) <= 1.01 * TICK_S / FADE_S, "no jump"
    assert shares[-1] == pytest.approx(1.0)


def back(link: LiveLink, start: int, ticks: int) -> Sequence[float]:
    """The share of its weight that the edge has, tick by tick, once the neighbour is heard again."""
    full = correction(0.0, 0.0, 3.0, 0.0, 1.0, GAINS)
    shares = []
    for tick in range(start, start + ticks):
        own = [said(1, t, 0.0) for t in range(tick - DELAY_TICKS - STALE_TICKS, tick + 1)]
        link.hear(tick, said(2, tick - DELAY_TICKS, 3.0))
        shares.append(link.part(tick, own, 1.0, GAINS) / full)
    return shares
