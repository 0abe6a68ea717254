"""What a process of endpoints reports to who started it, each of one vehicle."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Ready:
    """First report of a vehicle: it answers at these ports."""

    sysid: int
    tcp_port: int
    udp_port: int


@dataclass(frozen=True)
class Ended:
    """Last report of a vehicle whose clock was stopped.

    Attributes:
        tick: at which.
        rejected_samples: messages that were no samples.
        edges: (tick, neighbour, whether its edge counted from then on), of each change.
    """

    sysid: int
    tick: int
    rejected_samples: int
    edges: tuple[tuple[int, int, bool], ...] = ()


@dataclass(frozen=True)
class Failed:
    """Last report of a vehicle that cannot go on, and why; with its edges as in `Ended`, if it fails as scheduled."""

    sysid: int
    reason: str
    edges: tuple[tuple[int, int, bool], ...] = ()


Report = Ready | Ended | Failed
