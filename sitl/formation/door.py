"""The door: of all that comes over the network in another vehicle's name, only its samples, in order, are let in."""

from collections import Counter
from collections.abc import Callable, Sequence
from typing import Generic, Protocol, TypeVar


class Stamped(Protocol):
    """A sample of one vehicle at one tick."""

    @property
    def sysid(self) -> int: ...

    @property
    def tick(self) -> int: ...

    @property
    def sequence(self) -> int: ...


Sample = TypeVar("Sample", bound=Stamped)


class Door(Generic[Sample]):
    """What is let in of one vehicle's samples.

    Args:
        sysid: of the vehicle.
        decode: the samples in a message, at least one; raises ValueError when it has none.
        called: what they are, for people.

    Attributes:
        refused: messages that were not, by reason.
    """

    def __init__(self, sysid: int, decode: Callable[[bytes], list[Sample]], called: str) -> None:
        self.refused: Counter[str] = Counter()
        self._sysid = sysid
        self._decode = decode
        self._called = called
        self._last: Sample | None = None
        self._complaints: list[str] = []

    def admit(self, payload: bytes, latest_tick: int) -> list[Sample]:
        """The samples in a message; none when anything is wrong with it, which is counted.

        Args:
            latest_tick: no sample can be of a later one.
        """
        try:
            samples = self._decode(payload)
            self._check(samples, latest_tick)
        except ValueError as error:
            reason = str(error)
            if not self.refused[reason]:
                self._complaints.append(f"{self._called} of {self._sysid} refused: {reason}")
            self.refused[reason] += 1
            return []
        self._last = samples[-1]
        return samples

    def reopen(self) -> None:
        """It has come back, and may begin anew."""
        self._last = None

    def complaints(self) -> list[str]:
        """For people, a line for each reason that is new since it was last asked."""
        found, self._complaints = self._complaints, []
        return found

    def _check(self, samples: Sequence[Sample], latest_tick: int) -> None:
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
