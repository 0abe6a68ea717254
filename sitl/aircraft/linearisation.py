"""Feedback linearisation: from wanted accelerations to bank, lift and thrust (equations (25)-(28))."""

import math

from missions.airframe import GRAVITY_M_S2, Airframe, drag_n, lift_max_n, thrust_max_n
from sitl.aircraft.point_mass import AirState, Controls


def controls_for(ux: float, uy: float, uh: float, state: AirState, airframe: Airframe) -> Controls:
    """Bank, lift and thrust that give the accelerations (ux, uy, uh), as far as the airframe's limits allow.

    Equations (26)-(28) with the brackets of (27) restored. In this order: lift is limited by load factor and stall,
    drag follows from the limited lift, thrust lies between 0 and what there is, bank within its limit.

    Args:
        ux, uy, uh: wanted accelerations east, north and up, m/s^2.
    """
    cos_chi = math.cos(state.chi)
    sin_chi = math.sin(state.chi)
    cos_gamma = math.cos(state.gamma)
    sin_gamma = math.sin(state.gamma)
    m = airframe.mass_kg
    along = ux * cos_chi + uy * sin_chi
    normal = (uh + GRAVITY_M_S2) * cos_gamma - along * sin_gamma
    lateral = uy * cos_chi - ux * sin_chi
    bank = math.atan2(lateral, normal)
    lift = min(m * math.sqrt(normal * normal + lateral * lateral), lift_max_n(state.V, airframe))
    drag = drag_n(state.V, lift, airframe)
    thrust = m * ((uh + GRAVITY_M_S2) * sin_gamma + along * cos_gamma) + drag
    return Controls(
        min(max(thrust, 0.0), thrust_max_n(state.V, airframe)),
        lift,
        min(max(bank, -airframe.bank_max), airframe.bank_max),
    )
