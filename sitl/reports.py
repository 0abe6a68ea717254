"""What a process of endpoints reports to who started it, most of it of one vehicle."""

from dataclasses import dataclass

from missions.reassignment import Loss
from sitl.avoidance.yielding import Yielding
from sitl.formation.link_report import LinkReport


@dataclass(frozen=True)
class Hatched:
    """First report of a process: its number."""

    pid: int


@dataclass(frozen=True)
class Died:
    """Last report of a process, made for it: its exit code, minus the number of the signal that ended it."""

    exit_code: int


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
        links: what came of those to it.
        behind_s: wall time by which its clock has fallen behind at the most, in real time.
        edges: (tick, neighbour, whether its edge counted from then on), of each change.
        yieldings: who was given way to.
        losses: that were not scheduled, as the vehicles have agreed on them, where places are reassigned.
    """

    sysid: int
    tick: int
    links: tuple[LinkReport, ...] = ()
    behind_s: float = 0.0
    edges: tuple[tuple[int, int, bool], ...] = ()
    yieldings: tuple[Yielding, ...] = ()
    losses: tuple[Loss, ...] = ()


@dataclass(frozen=True)
class Failed:
    """Last report of a vehicle that cannot go on, and why; with edges and yieldings as in `Ended`, if it fails as
    scheduled."""

    sysid: int
    reason: str
    edges: tuple[tuple[int, int, bool], ...] = ()
    yieldings: tuple[Yielding, ...] = ()


Report = Hatched | Ready | Ended | Failed | Died
