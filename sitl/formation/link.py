"""What one vehicle hears of a neighbour: which sample is its newest, and how far it is to be trusted.

The functions keep to the dialect that plain Python and numba compute bit for bit alike.
"""

from collections.abc import Iterator, Sequence
from typing import Any

from sitl.formation.channel import LOST, Channel, carried
from sitl.formation.correction import Correction
from sitl.formation.disturbance import DelayLine
from sitl.formation.failures import Interval, within
from sitl.formation.law import Gains, correction
from sitl.formation.swarm_clock import neighbours_need
from sitl.ticks import TICK_S

FADE_S = 10.0
"""An edge that is new, or back, gains its weight evenly within this time, so that nobody jumps."""
NO_NEEDS = (0.0, 0.0)
NEVER = -1
"""No sample has been heard."""


def arrive(stamp: int, tick: int, arrivals: Any) -> None:
    """Note that the sample stamped so arrives at a tick; `arrivals`, a ring over ticks, holds the newest of each."""
    slot = tick % len(arrivals)
    arrivals[slot] = max(arrivals[slot], stamp)


def newest_heard(tick: int, newest: int, arrivals: Any) -> int:
    """The newest stamp heard up to a tick, from that of the tick before."""
    slot = tick % len(arrivals)
    newest = max(newest, arrivals[slot])
    arrivals[slot] = NEVER
    return newest


def trusted(trust: float, used: bool) -> float:
    """The share of its weight that an edge has at the next tick."""
    return min(1.0, trust + TICK_S / FADE_S) if used else 0.0


def waiting(trust: float, patient: bool) -> float:
    """The same while nothing has been heard yet: what it was for as long as a first sample may be on its way."""
    return trust if patient else 0.0


class Link:
    """One link, at its receiver.

    Args:
        channel: of the link.
        draws: uniform, `DRAWS` for each sample in order of sequence number; None for a channel that needs none.
        silences: by the sender's ticks.
        stale_ticks: see `Network`.
        trust: at the beginning: 1 for an edge that is there from the start.
        clocked: the swarm has a clock.

    Attributes:
        trust: share of its weight that the edge has.
        used: whether the edge counted at this tick.
        needs: the rates at which the neighbour would have the schedule slow down, and hurry.
        line: what a disturbance does after the channel; None while there has been none.
    """

    def __init__(
        self,
        channel: Channel,
        draws: Iterator[tuple[float, ...]] | None,
        silences: Sequence[Interval],
        stale_ticks: int,
        trust: float,
        *,
        clocked: bool = False,
    ) -> None:
        self.channel = channel
        self.trust = trust
        self.used = False
        self.needs = NO_NEEDS
        self.line: DelayLine | None = None
        self._clocked = clocked
        self._draws = draws
        self._silences = list(silences)
        self._oldest_ticks = channel.delay_ticks + channel.jitter_ticks + stale_ticks
        self._in_burst = False
        self._arrived = NEVER
        self._newest = NEVER
        self._sample: Correction | None = None
        self._arrivals = [NEVER] * (channel.jitter_ticks + 1)
        self._samples: dict[int, Correction] = {}
        self._only_delays = draws is None and not self._silences

    def hear(self, tick: int, sample: Correction | None) -> None:
        """Take in what the neighbour said `delay_ticks` ago; None when it said nothing. Once a tick."""
        if not self._only_delays:
            sample = self._through_channel(tick, sample)
        if self.line is not None:
            sample = self.line.carry(tick, sample)
        if sample is not None and sample.tick > self._newest:
            self._newest, self._sample = sample.tick, sample

    def age_ticks(self, tick: int) -> int | None:
        """How old the newest sample that has come through is at a tick; None before the first."""
        return None if self._sample is None else tick - self._newest

    def _through_channel(self, tick: int, sample: Correction | None) -> Correction | None:
        """The newest that the channel lets through at a tick, if it is newer than all before."""
        delay = self.channel.delay_ticks
        stamp = tick - delay
        if stamp >= 0 and self._draws is not None:
            jitter, loss, change = next(self._draws)
            self._in_burst, delay = carried(self._in_burst, (jitter, loss, change), self.channel)
        if sample is not None and delay != LOST and not within(stamp, self._silences):
            self._samples[stamp] = sample
            arrive(stamp, stamp + delay, self._arrivals)
        before = self._arrived
        self._arrived = newest_heard(tick, before, self._arrivals)
        if self._arrived == before:
            return None
        newest = self._samples[self._arrived]
        for overtaken in range(before, self._arrived + 1):
            self._samples.pop(overtaken, None)
        return newest

    def part(self, tick: int, own: Sequence[Correction], weight: float, gains: Gains) -> float:
        """The neighbour's part of the law's corrections. Call it once a tick, after `hear`.

        Args:
            own: the vehicle's own deviations, that of this tick last.
            weight: a_pq; 0 while there is no such edge.
        """
        self.used = False
        sample = self._sample
        if sample is None:
            self.trust = waiting(self.trust, tick <= self._oldest_ticks and weight > 0.0)
            return 0.0
        mine, other = self._pair(tick, own, sample)
        flying = own[-1].in_formation and mine.in_formation and other.in_formation
        fresh = mine.tick == other.tick and tick - self._newest <= self._oldest_ticks
        self.used = flying and weight > 0.0 and fresh
        part = 0.0
        if self.used:
            part = correction(
                mine.along_m, mine.along_rate_m_s, other.along_m, other.along_rate_m_s, weight * self.trust, gains
            )
        if self._clocked:
            self.needs = _needs(own[-1], other) if self.used else NO_NEEDS
        self.trust = trusted(self.trust, self.used)
        return part

    def _pair(self, tick: int, own: Sequence[Correction], sample: Correction) -> tuple[Correction, Correction]:
        """The own and the neighbour's deviation, of one moment."""
        return own[-1 - min(tick - self._newest, len(own) - 1)], sample


def _needs(own: Correction, other: Correction) -> tuple[float, float]:
    return (
        neighbours_need(own.slowed_s, other.slowed_s, other.slowed_rate),
        neighbours_need(own.hurried_s, other.hurried_s, other.hurried_rate),
    )
