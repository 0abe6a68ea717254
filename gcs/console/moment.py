"""A swarm at one moment, as it is shown."""

from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.float64]


@dataclass(frozen=True)
class ShownLink:
    """A link between two vehicles of a formation.

    Attributes:
        pair: their sysids.
        age_s: of the newest correction that counts, the older of both directions; None when none has come.
    """

    pair: tuple[int, int]
    age_s: float | None


@dataclass(frozen=True)
class Moment:
    """Where everybody is.

    Attributes:
        t_s: simulated time.
        sysids: of the vehicles; rows below are in their order.
        position_m: (n, 3) in the local frame; NaN where it is not known.
        attitude_rad: (n, 3) roll to the right, pitch up, and heading anticlockwise from east.
        lost: of the vehicles, those that are where they were seen last.
    """

    t_s: float
    sysids: tuple[int, ...]
    position_m: FloatArray
    attitude_rad: FloatArray
    lost: frozenset[int] = frozenset()


@dataclass(frozen=True)
class Row:
    """What the table says of one vehicle; None is not known.

    Attributes:
        mode: or what has become of it.
        item: of its mission that it flies to, and the last, if it tells.
        error_m: how far ahead of its schedule it is; off its track, where it has none.
        link: age of the oldest correction that it goes by, or how long it has been silent, for people.
        well: whether nothing of it needs attention.
    """

    sysid: int
    name: str
    mode: str
    item: tuple[int, int | None] | None = None
    speed_m_s: float | None = None
    altitude_m: float | None = None
    error_m: float | None = None
    link: str = ""
    well: bool = True


@dataclass(frozen=True)
class Course:
    """Figures of merit over time, (k,) each; NaN where one is not defined.

    Attributes:
        error_m: RMS formation error over the edges.
        separation_m: least distance between any two vehicles.
        delay_s: of the corrections that the vehicles go by, on the average.
        now: how many of them lie in the past; the others are of a recording.
    """

    t_s: FloatArray = field(default_factory=lambda: np.empty(0))
    error_m: FloatArray = field(default_factory=lambda: np.empty(0))
    separation_m: FloatArray = field(default_factory=lambda: np.empty(0))
    delay_s: FloatArray = field(default_factory=lambda: np.empty(0))
    now: int = 0
