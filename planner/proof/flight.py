"""Airspeed and climb rate of all flights at every instant of their schedules."""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from missions.scenario import Scenario
from planner.proof.bracket import Least, between, even, least
from planner.proof.separation import WINDOW_S
from planner.proof.tracks import Tracks

FloatArray = npt.NDArray[np.float64]
IntArray = npt.NDArray[np.int64]


@dataclass(frozen=True)
class SpareSpeeds:
    """What each flight, (n,), keeps from the airframe's limits, m/s, at the times `at`; negative beyond them.

    Of the airspeed in the forecast wind above its least and below its largest value, and of the climb rate above its
    least (the fastest descent) and below its largest value.
    """

    slow: Least
    fast: Least
    descent: Least
    climb: Least


def spare_speeds(tracks: Tracks, scenario: Scenario) -> SpareSpeeds:
    """Bracket airspeeds and climb rates, as far as it takes to know that they keep to the airframe's limits.

    Both are as smooth as the velocity: they change by no more than the acceleration.
    """
    airframe, wind = scenario.airframe, np.array(scenario.wind.forecast_m_s)
    windows = even(np.zeros(len(tracks)), tracks.durations_s, WINDOW_S)

    def velocities(row: IntArray, t_s: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Airspeeds and climb rates."""
        s, speed = tracks.progress(row, t_s)
        heading, climb = tracks.headings(row, s), speed * tracks.slopes(row, s)
        u, v = speed * np.cos(heading) - wind[0], speed * np.sin(heading) - wind[1]
        return np.sqrt(u**2 + v**2 + climb**2), climb

    def spare(which: int, sign: float, limit: float) -> Least:
        def bounds(row: IntArray, a: FloatArray, b: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
            start, end = (sign * (velocities(row, t)[which] - limit) for t in (a, b))
            acceleration = tracks.motion(row, a, b).acceleration_m_s2
            lower = between(start, end, b - a, acceleration, np.full(len(row), np.inf))
            return lower, np.minimum(start, end), np.where(start <= end, a, b)

        return least(len(tracks), windows, bounds, 0.0)

    return SpareSpeeds(
        slow=spare(0, 1.0, airframe.airspeed_min_m_s),
        fast=spare(0, -1.0, airframe.airspeed_max_m_s),
        descent=spare(1, 1.0, airframe.climb_rate_min_m_s),
        climb=spare(1, -1.0, airframe.climb_rate_max_m_s),
    )
