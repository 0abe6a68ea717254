"""What the airframe lets a planner ask for: less than all of it, so that the law has something left to correct with."""

import math

from missions.airframe import GRAVITY_M_S2, Airframe, drag_n, thrust_max_n
from missions.scenario import Scenario

AIRSPEED_RESERVE_M_S = 2.0
"""Planned airspeeds stay this far inside [V_min, V_max] (MODEL, section 6, Schedule)."""
POWER_SHARE = 0.85
"""Part of the power there is that a planned leg may need."""


def airspeed_range_m_s(scenario: Scenario) -> tuple[float, float]:
    """Slowest and fastest planned airspeed."""
    airframe = scenario.airframe
    return airframe.airspeed_min_m_s + AIRSPEED_RESERVE_M_S, airframe.airspeed_max_m_s - AIRSPEED_RESERVE_M_S


def power_share(airspeed_m_s: float, sin_climb: float, airframe: Airframe) -> float:
    """Part of the thrust there is that steady flight takes at an airspeed and a climb angle (22), (24)."""
    weight = airframe.mass_kg * GRAVITY_M_S2
    lift = weight * math.sqrt(max(0.0, 1.0 - sin_climb * sin_climb))
    return (drag_n(airspeed_m_s, lift, airframe) + weight * sin_climb) / thrust_max_n(airspeed_m_s, airframe)


def flyable(airspeed_m_s: float, climb_m_s: float, slowest_m_s: float, fastest_m_s: float, airframe: Airframe) -> bool:
    """Whether a leg may be planned at an airspeed and a climb rate; kept to the dialect that numba compiles alike."""
    return (
        slowest_m_s <= airspeed_m_s <= fastest_m_s
        and airframe.climb_rate_min_m_s <= climb_m_s <= airframe.climb_rate_max_m_s
        and power_share(airspeed_m_s, climb_m_s / airspeed_m_s, airframe) <= POWER_SHARE
    )


def slope_range(scenario: Scenario, ground_speed_m_s: float) -> tuple[float, float]:
    """Steepest descent and climb, dz/ds, at a ground speed in still air.

    The smaller of the scenario's angle, the climb rates, what `POWER_SHARE` of the power gives, and the glide without
    any: steeper, it would arrive early.
    """
    airframe = scenario.airframe.airframe()
    limit = math.tan(math.radians(scenario.limits.climb_max_deg))
    weight = airframe.mass_kg * GRAVITY_M_S2
    drag = drag_n(ground_speed_m_s, weight, airframe)
    spare = POWER_SHARE * thrust_max_n(ground_speed_m_s, airframe) - drag
    by_power = math.tan(math.asin(min(1.0, max(0.0, spare / weight))))
    return (
        -min(limit, -airframe.climb_rate_min_m_s / ground_speed_m_s, drag / weight),
        min(limit, airframe.climb_rate_max_m_s / ground_speed_m_s, by_power),
    )
