"""What a vehicle's engine was asked for."""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from missions.airframe import Airframe, thrust_max_n
from sitl.aircraft.actuators import lag_gains
from sitl.ticks import TICK_S

FloatArray = npt.NDArray[np.float64]

NEAR_N = 1e-6
"""What recovering a command from the thrust that came of it leaves of rounding."""


@dataclass(frozen=True)
class Engine:
    """One vehicle's engine.

    Attributes:
        saturated: share of ticks at which all thrust that there was, or none, was asked for.
        effort_n_s: how much the thrust changes in a second, mean.
    """

    saturated: float
    effort_n_s: float


def engine_use(thrust_n: FloatArray, airspeed_m_s: FloatArray, airframe: Airframe) -> Engine:
    """Look at a flight's thrust.

    The record has the thrust that was given; what was asked for follows from the lag, which is exact over a tick.

    Args:
        thrust_n: (ticks,) at the end of each tick.
        airspeed_m_s: (ticks,) at its beginning.
    """
    steps = np.diff(thrust_n)
    if not len(steps):
        return Engine(0.0, 0.0)
    asked_n = thrust_n[:-1] + steps / lag_gains(airframe, TICK_S).thrust
    V = airspeed_m_s[1:]
    saturated = asked_n <= NEAR_N
    # Only what is more than there is at the highest airspeed can be all that there is at its own.
    for tick in np.flatnonzero(asked_n >= thrust_max_n(float(V.max()), airframe) - NEAR_N).tolist():
        saturated[tick] |= asked_n[tick] >= thrust_max_n(float(V[tick]), airframe) - NEAR_N
    return Engine(float(saturated.mean()), float(np.abs(steps).mean() / TICK_S))
