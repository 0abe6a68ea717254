"""What comes through one link of the intents: as rare as they are, the channel treats them as all samples."""

import heapq
from collections.abc import Iterator, Sequence

from sitl.avoidance.intent import PERIOD_TICKS, QUIET, Intent
from sitl.formation.channel import LOST, Channel, carried
from sitl.formation.failures import Interval, within


def channel_of_intents(channel: Channel) -> Channel:
    """The channel as samples meet it that are PERIOD_TICKS apart: a burst may have begun and ended meanwhile."""
    leaning = channel.enter + channel.leave
    if channel.enter == 0.0:
        return channel
    share = channel.enter / leaning
    changed = 1.0 - (1.0 - leaning) ** PERIOD_TICKS
    return channel._replace(enter=share * changed, leave=(1.0 - share) * changed)


class IntentLink:
    """One link, at its receiver.

    Args:
        channel: as intents meet it.
        draws: uniform, `DRAWS` for each intent in order; None for a channel that needs none.
        silences: by the sender's ticks.
    """

    def __init__(
        self, channel: Channel, draws: Iterator[tuple[float, ...]] | None, silences: Sequence[Interval]
    ) -> None:
        self._channel = channel
        self._draws = draws
        self._silences = list(silences)
        self._drawn = 0
        self._in_burst = False
        self._newest = -1
        self._due: list[tuple[int, Intent]] = []

    def arrive(self, intent: Intent, took_ticks: int = 0) -> None:
        """An intent has come; on a network that takes its time, so many whole ticks after its stamp."""
        delay = self._delay_ticks(intent.sequence)
        if intent.status != QUIET and delay != LOST and not within(intent.tick, self._silences):
            heapq.heappush(self._due, (intent.tick + took_ticks + delay, intent))

    def newer(self, tick: int) -> Intent | None:
        """The newest that counts by now, if it is newer than any before; QUIET ones tell nothing."""
        found = None
        while self._due and self._due[0][0] <= tick:
            _, intent = heapq.heappop(self._due)
            if intent.tick > self._newest:
                self._newest, found = intent.tick, intent
        return found

    def _delay_ticks(self, sequence: int) -> int:
        """What becomes of an intent; also of those before it that never came."""
        if self._draws is None:
            return self._channel.delay_ticks
        delay = LOST
        while self._drawn <= sequence:
            jitter, loss, change = next(self._draws)
            self._in_burst, delay = carried(self._in_burst, (jitter, loss, change), self._channel)
            self._drawn += 1
        return delay
