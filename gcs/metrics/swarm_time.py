"""When the swarm's clock showed what: a flight whose schedule was slowed or hurried is compared with its plan by it."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from sitl.ticks import TICK_S

FloatArray = npt.NDArray[np.float64]


@dataclass(frozen=True)
class SwarmTime:
    """The swarm's clock over a flight.

    Attributes:
        t_s: (n_tick,) time since the launch.
        slowed_s, hurried_s: (n_tick,) the greatest sum of any vehicle by then: where the sums of all go.
    """

    t_s: FloatArray
    slowed_s: FloatArray
    hurried_s: FloatArray

    @property
    def shown_s(self) -> FloatArray:
        """(n_tick,) what the clock showed."""
        return self.t_s - self.slowed_s + self.hurried_s

    def flown_at(self, planned_s: FloatArray) -> FloatArray:
        """When the clock showed these times, (n,); NaN where it never did."""
        times: FloatArray = np.interp(planned_s, self.shown_s, self.t_s, right=np.nan)
        return times

    def shown_at(self, t_s: float) -> float:
        """What the clock showed at a time."""
        return float(np.interp(t_s, self.t_s, self.shown_s))


def swarm_time(shifts: Mapping[int, FloatArray]) -> SwarmTime:
    """The clock, from what vehicles recorded: by sysid, (n_tick, 2) rows of seconds slowed and hurried.

    What a vehicle has recorded once its path was over does not count.
    """
    ticks = max(map(len, shifts.values()))
    sums = np.zeros((ticks, 2))
    for rows in shifts.values():
        np.maximum(sums[: len(rows)], rows, out=sums[: len(rows)])
    sums = np.maximum.accumulate(sums)
    return SwarmTime(np.arange(ticks, dtype=np.float64) * TICK_S, sums[:, 0], sums[:, 1])
