"""How one link of a flying swarm stands."""

from dataclasses import dataclass


@dataclass(frozen=True)
class LinkState:
    """One link, at its receiver, as of the last tick at which the law ran.

    Attributes:
        sender, receiver: system ids.
        age_s: simulated time since the stamp of the newest correction that has come through; None before the first.
        used: whether its edge counts.
        trust: share of its weight that the edge has.
    """

    sender: int
    receiver: int
    age_s: float | None
    used: bool
    trust: float
