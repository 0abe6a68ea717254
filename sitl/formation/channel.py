"""What the network does to a sample on its way: delay, jitter, loss, alone and in bursts (MODEL, section 7).

The receiver applies it, by draws keyed by link and sequence number, so that a flight repeats and lockstep never waits
for a sample that was "lost". `carried` keeps to the dialect that plain Python and numba compute bit for bit alike.
"""

from typing import NamedTuple

LOST = -1
DRAWS = 3
"""Uniform draws that a sample takes."""


class Channel(NamedTuple):
    """One link, in ticks and probabilities a sample.

    Bursts are those of Gilbert and Elliott: a link is well or in a burst, and changes by chance with each sample.

    Attributes:
        delay_ticks: least delay, at least 1; so far a receiver in lockstep may run ahead of the sender.
        jitter_ticks: added to it, evenly distributed from 0 to this.
        loss: outside bursts.
        enter, leave: of a burst to begin, and to end.
        burst_loss: in a burst.
    """

    delay_ticks: int
    jitter_ticks: int = 0
    loss: float = 0.0
    enter: float = 0.0
    leave: float = 1.0
    burst_loss: float = 1.0

    @property
    def certain(self) -> bool:
        """Whether no draws are needed."""
        return self.jitter_ticks == 0 and self.loss == 0.0 and self.enter == 0.0


def carried(in_burst: bool, draws: tuple[float, float, float], channel: Channel) -> tuple[bool, int]:
    """What becomes of the next sample: whether the link is in a burst with it, and its delay in ticks, or LOST."""
    jitter, loss, change = draws
    in_burst = change >= channel.leave if in_burst else change < channel.enter
    if loss < (channel.burst_loss if in_burst else channel.loss):
        return in_burst, LOST
    return in_burst, channel.delay_ticks + int(jitter * (channel.jitter_ticks + 1))
