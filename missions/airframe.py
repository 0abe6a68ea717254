"""The aircraft as a point mass sees it: drag, thrust and limits.

The functions keep to the dialect that plain Python and numba compute bit for bit alike: no powers, no `sum`,
plain floats in and out.
"""

from typing import NamedTuple

GRAVITY_M_S2 = 9.80665
"""Standard gravity (ISO 80000-3)."""
AIR_DENSITY_KG_M3 = 1.225
"""Constant sea-level density (ISA). At 4 km there is a third less; stated, not modelled."""


class Airframe(NamedTuple):
    """Constants of one aircraft type. SI units, angles in radians."""

    mass_kg: float
    wing_area_m2: float
    drag_coefficient_zero_lift: float
    induced_drag_factor: float
    """k of C_D = C_D0 + k C_L^2."""
    lift_coefficient_max: float
    shaft_power_w: float
    propeller_efficiency: float
    static_thrust_n: float
    airspeed_min_m_s: float
    airspeed_max_m_s: float
    airspeed_cruise_m_s: float
    climb_rate_min_m_s: float
    climb_rate_max_m_s: float
    load_factor_max: float
    bank_max: float
    thrust_lag_s: float
    bank_lag_s: float
    lift_lag_s: float


def dynamic_pressure_area(airspeed_m_s: float, airframe: Airframe) -> float:
    """q S in newtons: dynamic pressure times wing area."""
    return 0.5 * AIR_DENSITY_KG_M3 * airspeed_m_s * airspeed_m_s * airframe.wing_area_m2


def drag_n(airspeed_m_s: float, lift_n: float, airframe: Airframe) -> float:
    """Drag D = q S (C_D0 + k C_L^2) in newtons (MODEL, section 5)."""
    qs = dynamic_pressure_area(airspeed_m_s, airframe)
    lift_coefficient = lift_n / qs
    return qs * (
        airframe.drag_coefficient_zero_lift + airframe.induced_drag_factor * lift_coefficient * lift_coefficient
    )


def thrust_max_n(airspeed_m_s: float, airframe: Airframe) -> float:
    """The most thrust there is at an airspeed: min(static, efficiency x power / V), in newtons."""
    return min(airframe.static_thrust_n, airframe.propeller_efficiency * airframe.shaft_power_w / airspeed_m_s)


def lift_max_n(airspeed_m_s: float, airframe: Airframe) -> float:
    """The most lift there is at an airspeed: the smaller of load factor and stall limits, in newtons."""
    by_load = airframe.load_factor_max * airframe.mass_kg * GRAVITY_M_S2
    return min(by_load, airframe.lift_coefficient_max * dynamic_pressure_area(airspeed_m_s, airframe))
