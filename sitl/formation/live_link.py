"""What one vehicle makes of a neighbour's samples in real time, where they may come late, or not at all."""

from collections.abc import Sequence

from sitl.formation.correction import Correction
from sitl.formation.link import Link
from sitl.ticks import TICK_S


class LiveLink(Link):
    """A link that takes what there is: see `Arrivals`, which applies the channel.

    A sample up to the channel's delay and jitter old is paired with the own state of its moment, as in lockstep. An
    older one is carried on by its velocity to so many ticks ago; when it is too old for that the edge is dropped.
    """

    def _pair(self, tick: int, own: Sequence[Correction], sample: Correction) -> tuple[Correction, Correction]:
        moment = max(sample.tick, tick - self.channel.delay_ticks - self.channel.jitter_ticks)
        later_s = (moment - sample.tick) * TICK_S
        carried_on = sample._replace(
            tick=moment,
            along_m=sample.along_m + sample.along_rate_m_s * later_s,
        )
        return own[-1 - min(tick - moment, len(own) - 1)], carried_on
