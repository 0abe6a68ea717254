"""The door: of all that comes over the network in a neighbour's name, only its samples, in order, are let in."""

from collections import Counter
from collections.abc import Sequence

from sitl.formation.correction import Correction, decode


class Door:
    """What is let in of one neighbour.

    Args:
        sysid: of the neighbour.

    Attributes:
        refused: messages that were not, by reason.
    """

    def __init__(self, sysid: int) -> None:
        self.refused: Counter[str] = Counter()
        self._sysid = sysid
        self._last: Correction | None = None
        self._complaints: list[str] = []

    def admit(self, payload: bytes, latest_tick: int) -> list[Correction]:
        """The samples in a message; none when anything is wrong with it, which is counted.

        Args:
            latest_tick: no sample can be of a later one.
        """
        try:
            samples = decode(payload)
            self._check(samples, latest_tick)
        except ValueError as error:
            reason = str(error)
            if not self.refused[reason]:
                self._complaints.append(f"Corrections of {self._sysid} refused: {reason}")
            self.refused[reason] += 1
            return []
        self._last = samples[-1]
        return samples

    def reopen(self) -> None:
        """The neighbour has come back, and may begin anew."""
        self._last = None

    def complaints(self) -> list[str]:
        """For people, a line for each reason that is new since it was last asked."""
        found, self._complaints = self._complaints, []
        return found

    def _check(self, samples: Sequence[Correction], latest_tick: int) -> None:
        before = None
        for sample in samples:
            if sample.sysid != self._sysid:
                raise ValueError("another's system id")
            if sample.tick < 0 or (before is not None and sample.tick <= before.tick):
                raise ValueError("time goes backwards")
            if before is not None and sample.sequence <= before.sequence:
                raise ValueError("sequence goes backwards")
            before = sample
        newest, last = samples[-1], self._last
        if newest.tick > latest_tick:
            raise ValueError("far in the future")
        # The newest may come twice: who finds a neighbour back says it again.
        if last is not None and newest.tick < last.tick:
            raise ValueError("time goes backwards")
        if last is not None and not 0 <= newest.sequence - last.sequence <= newest.tick - last.tick:
            raise ValueError("sequence out of step with time")  # there is one sample a tick at most
