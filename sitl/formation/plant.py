"""One vehicle along its track as a linear system: deviation, its rate, and what the engine adds."""

import math
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from missions.airframe import GRAVITY_M_S2, Airframe, drag_n
from sitl.ticks import TICK_S

Array = npt.NDArray[np.float64]

SLOPE_STEP_M_S = 0.01


class Plant(NamedTuple):
    """x' or the next x = A x + B u with states (e, e', ...), (d, d) and (d,); u is the acceleration asked for."""

    A: Array
    B: Array


def point_plant() -> Plant:
    """A point that accelerates as asked, over one tick with u held."""
    return Plant(np.array([[1.0, TICK_S], [0.0, 1.0]]), np.array([0.5 * TICK_S**2, TICK_S]))


def drag_slope(airframe: Airframe) -> float:
    """d(D/m)/dV in level flight at cruise, 1/s."""
    weight, V = airframe.mass_kg * GRAVITY_M_S2, airframe.airspeed_cruise_m_s
    above, below = (drag_n(V + step, weight, airframe) for step in (SLOPE_STEP_M_S, -SLOPE_STEP_M_S))
    return (above - below) / (2.0 * SLOPE_STEP_M_S * airframe.mass_kg)


def aircraft_plant(airframe: Airframe) -> Plant:
    """An aircraft over one tick: states (e, e', thrust over mass).

    As it is flown: thrust m (u + D(V) / m) is asked for; the engine goes a share of the way there at once, and that
    thrust holds over the tick. Drag acts at once and is made up for through the lag, so that its slope damps a little.
    """
    slope, share = drag_slope(airframe), -math.expm1(-TICK_S / airframe.thrust_lag_s)
    engine = np.array([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, share * slope, 1.0 - share]])
    decay = -math.expm1(-slope * TICK_S) / slope if slope else TICK_S
    travel = (TICK_S - decay) / slope if slope else 0.5 * TICK_S**2
    motion = np.array([[1.0, decay, travel], [0.0, 1.0 - slope * decay, decay], [0.0, 0.0, 1.0]])
    return Plant(motion @ engine, motion @ np.array([0.0, 0.0, share]))


def aircraft_rates(airframe: Airframe) -> Plant:
    """The same aircraft in continuous time.

    The thrust of a tick is what the lag reaches at its end, which makes up for the hold: rates of decay differ from
    those of the ticks by less than a per cent.
    """
    slope, lag = drag_slope(airframe), airframe.thrust_lag_s
    rates = np.array([[0.0, 1.0, 0.0], [0.0, -slope, 1.0], [0.0, slope / lag, -1.0 / lag]])
    return Plant(rates, np.array([0.0, 0.0, 1.0 / lag]))
