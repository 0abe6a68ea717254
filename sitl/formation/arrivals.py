"""What comes through one link in real time: each sample takes what the network takes, and the channel's delay then."""

import heapq
from collections.abc import Iterator, Sequence

from sitl.formation.channel import LOST, Channel, carried
from sitl.formation.correction import Correction
from sitl.formation.failures import Interval, within
from sitl.ticks import TICK_S


class Arrivals:
    """One link, at its receiver.

    A sample counts as many whole ticks later than its stamp as the network took, and the channel's delay after that: on
    a network that takes less than a tick, exactly when it would in lockstep.

    Args:
        channel: of the link.
        draws: uniform, `DRAWS` for each tick of the sender in order; None for a channel that needs none.
        silences: by the sender's ticks.

    Attributes:
        heard: samples that came.
        late: of these, those that took a tick or more: lockstep would have waited for them.
        lost: those that never came, told from gaps in the sequence numbers.
    """

    def __init__(
        self, channel: Channel, draws: Iterator[tuple[float, ...]] | None, silences: Sequence[Interval]
    ) -> None:
        self.heard = self.late = self.lost = 0
        self._channel = channel
        self._draws = draws
        self._silences = list(silences)
        self._drawn_tick = 0
        self._in_burst = False
        self._sequence: int | None = None
        self._due: list[tuple[int, Correction]] = []
        self._delay_sum_ticks = self._delay_max_ticks = 0.0

    @property
    def delay_mean_s(self) -> float | None:
        """From the stamps to when the samples counted; None without any."""
        return self._delay_sum_ticks / self.heard * TICK_S if self.heard else None

    @property
    def delay_max_s(self) -> float | None:
        """The longest of them."""
        return self._delay_max_ticks * TICK_S if self.heard else None

    def arrive(self, sample: Correction, now_ticks: float) -> None:
        """A sample has come at a moment, in ticks of simulated time as the clock of all has it."""
        if self._sequence is not None:
            if sample.sequence <= self._sequence:
                return
            self.lost += sample.sequence - self._sequence - 1
        self._sequence = sample.sequence
        took_ticks = max(0.0, now_ticks - sample.tick)
        model_ticks = self._model_ticks(sample.tick)
        if model_ticks == LOST or within(sample.tick, self._silences):
            model_ticks = LOST
        else:
            heapq.heappush(self._due, (sample.tick + int(took_ticks) + model_ticks, sample))
        delay_ticks = took_ticks + max(model_ticks, self._channel.delay_ticks)
        self.heard += 1
        self.late += took_ticks >= 1.0
        self._delay_sum_ticks += delay_ticks
        self._delay_max_ticks = max(self._delay_max_ticks, delay_ticks)

    def newest(self, tick: int) -> Correction | None:
        """The newest of the samples that begin to count at a tick; None without any."""
        newest = None
        while self._due and self._due[0][0] <= tick:
            _, sample = heapq.heappop(self._due)
            if newest is None or sample.tick > newest.tick:
                newest = sample
        return newest

    def _model_ticks(self, stamp: int) -> int:
        """What the channel's model does to the sample of a tick; also to those before it that never came."""
        if self._draws is None:
            return self._channel.delay_ticks
        delay_ticks = LOST
        while self._drawn_tick <= stamp:
            jitter, loss, change = next(self._draws)
            self._in_burst, delay_ticks = carried(self._in_burst, (jitter, loss, change), self._channel)
            self._drawn_tick += 1
        return delay_ticks
