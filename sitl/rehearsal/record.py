"""What is written down of a rehearsed flight."""

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.float64]
Flags = npt.NDArray[np.bool_]


class Record(NamedTuple):
    """Of each vehicle and tick.

    Attributes:
        truth: (n, ticks, 6) as in `sitl.truth`.
        thrust_n: (n, ticks) that the engine gave over the tick.
        in_formation: (n, ticks) whether it flew its schedule.
        along_m, along_rate_m_s: (n, ticks) e and e'; the rate is NaN off the path.
        shifts: (n, ticks, 4) what its schedule had been slowed, the rate of that, the same of what it had been hurried.
        used: (links, ticks) whether the edge counted.
        arrived: (n,) tick at which the path's end was passed; -1 before.
    """

    truth: FloatArray
    thrust_n: FloatArray
    in_formation: Flags
    along_m: FloatArray
    along_rate_m_s: FloatArray
    shifts: FloatArray
    used: Flags
    arrived: npt.NDArray[np.int64]


def empty_record(vehicles: int, links: int, ticks: int) -> Record:
    """A record of nothing yet, with room for a number of ticks."""
    return Record(
        truth=np.empty((vehicles, ticks, 6)),
        thrust_n=np.empty((vehicles, ticks)),
        in_formation=np.zeros((vehicles, ticks), dtype=np.bool_),
        along_m=np.empty((vehicles, ticks)),
        along_rate_m_s=np.full((vehicles, ticks), np.nan),
        shifts=np.zeros((vehicles, ticks, 4)),
        used=np.zeros((links, ticks), dtype=np.bool_),
        arrived=np.full(vehicles, -1),
    )
