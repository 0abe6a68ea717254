"""How near a vehicle came to its limits (29)."""

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from gcs.truth import CHI, H, V
from sitl.ticks import TICK_S

FloatArray = npt.NDArray[np.float64]

WINDOW_TICKS = round(1.0 / TICK_S)
"""Rates are means over a second: a gust turns the air velocity from one tick to the next without any command."""


@dataclass(frozen=True)
class FlightLimits:
    """One vehicle's extremes from 30 m above ground to its arrival; rates are None for less than a second of it."""

    sysid: int
    airspeed_min_m_s: float
    airspeed_max_m_s: float
    climb_rate_min_m_s: float | None
    climb_rate_max_m_s: float | None
    turn_rate_max_deg_s: float | None


def flight_limits(sysid: int, truth: FloatArray) -> FlightLimits:
    """The extremes of a truth, (n_tick, 6), that is cut to what counts."""
    window_s = WINDOW_TICKS * TICK_S
    climbs = (truth[WINDOW_TICKS:, H] - truth[:-WINDOW_TICKS, H]) / window_s
    heading = np.unwrap(truth[:, CHI])
    turns = np.abs(heading[WINDOW_TICKS:] - heading[:-WINDOW_TICKS]) / window_s
    return FlightLimits(
        sysid=sysid,
        airspeed_min_m_s=float(truth[:, V].min()),
        airspeed_max_m_s=float(truth[:, V].max()),
        climb_rate_min_m_s=float(climbs.min()) if len(climbs) else None,
        climb_rate_max_m_s=float(climbs.max()) if len(climbs) else None,
        turn_rate_max_deg_s=math.degrees(turns.max()) if len(turns) else None,
    )
