"""How much a link loses, from what has to be asked again, and how many copies of a message make up for it."""

import math

from sitl.services.round_trip import RoundTrip

MOST_COPIES = 4
_UNLIKELY = 0.05
"""A message is sent so often that all copies go unanswered with this probability, or less."""
_NOTICEABLE = 0.1
"""Below, a single loss has just been seen: nothing is sent twice."""
_WEIGHT = 1 / 8


class Loss:
    """The smoothed part of what was asked that had to be asked again. No loss is assumed to begin with.

    Attributes:
        part: 0 to 1.
    """

    def __init__(self) -> None:
        self.part = 0.0

    def measure(self, *, lost: bool) -> None:
        """Something asked for has come: at once, or only when it had been asked for again."""
        self.part += (lost - self.part) * _WEIGHT

    @property
    def copies(self) -> int:
        """How often to send a message for which another round trip would be waited; 1 on a good link."""
        if self.part < _NOTICEABLE:
            return 1
        return min(MOST_COPIES, math.ceil(math.log(_UNLIKELY) / math.log(self.part)))


def learn(round_trip: RoundTrip, loss: Loss, took_s: float, since_first_s: float | None = None) -> bool:
    """Learn from an answer how long answers take and how much is lost.

    An answer that comes sooner after a repeat than any ever has is one to the question before: that was not lost, the
    link is slower than was thought. Before anything is known, an answer to a repeat tells nothing. (The shortest round
    trip judges, not the smoothed one: what is too long would find itself confirmed by each repeat.)

    Args:
        round_trip, loss: what is known.
        took_s: since the question was sent last.
        since_first_s: since it was sent first; None when it was sent only once.

    Returns:
        Whether it answers the question as it was sent last.
    """
    if since_first_s is None:
        round_trip.measure(took_s)
        loss.measure(lost=False)
        return True
    if round_trip.smoothed_s is None:
        return False
    early = took_s < round_trip.least_s / 2
    if early:
        round_trip.measure(since_first_s)
    loss.measure(lost=not early)
    return not early
