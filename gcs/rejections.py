"""What came in and had no effect, counted by who sent it, for people to read."""

from collections import Counter

from sitl.services.signing import Verdict


class Rejections:
    """The counts of one fleet."""

    def __init__(self) -> None:
        self._signatures: dict[int, Counter[Verdict]] = {}

    def count(self, sysid: int, verdict: Verdict) -> None:
        """A frame of this system has not been let in."""
        self._signatures.setdefault(sysid, Counter())[verdict] += 1

    def of(self, sysid: int) -> list[str]:
        """What was not let in of one system, and what to do; empty when nothing was."""
        return [
            f"vehicle {sysid}: {count} {'frame' if count == 1 else 'frames'} {verdict.value}: {_ADVICE[verdict]}"
            for verdict, count in self._signatures.get(sysid, {}).items()
        ]

    def all(self) -> list[str]:
        """The same of all systems."""
        return [line for sysid in sorted(self._signatures) for line in self.of(sysid)]


_ADVICE = {
    Verdict.UNSIGNED: "give it the key",
    Verdict.WRONG: "check the key",
    Verdict.OLD: "check its clock and the station's, or someone plays back old traffic",
}
