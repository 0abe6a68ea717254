"""What a station adds to all links of a flying swarm, on top of what their channels do: delay and loss."""

from collections.abc import Iterator
from dataclasses import dataclass

from sitl.formation.correction import Correction

DISTURBANCE_DRAWS = 1
"""Uniform draws that a delay line takes a tick."""


@dataclass(frozen=True)
class Disturbance:
    """In force from a tick on, until the next.

    Attributes:
        delay_ticks: added to each sample's.
        loss: probability that a sample is lost.
        from_tick: of the receiver.
    """

    delay_ticks: int = 0
    loss: float = 0.0
    from_tick: int = 0


UNDISTURBED = Disturbance()


class DelayLine:
    """What a disturbance does to one link, at its receiver, after the channel. Samples that are under way keep their
    delay when it changes, so that later ones may overtake them.

    Args:
        draws: uniform, `DISTURBANCE_DRAWS` for each tick from the first on.

    Attributes:
        disturbance: in force.
    """

    def __init__(self, draws: Iterator[tuple[float, ...]]) -> None:
        self.disturbance = UNDISTURBED
        self._draws = draws
        self._due: dict[int, Correction] = {}

    def carry(self, tick: int, sample: Correction | None) -> Correction | None:
        """What counts at a tick, given what has come through the channel at it; None for nothing. Once a tick."""
        (draw,) = next(self._draws)
        if sample is not None and draw >= self.disturbance.loss:
            due = tick + self.disturbance.delay_ticks
            self._due[due] = max(sample, self._due.get(due, sample), key=lambda one: one.tick)
        return self._due.pop(tick, None)
