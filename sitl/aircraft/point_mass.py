"""The point mass of equations (19)-(24) and its integration."""

import math
from typing import NamedTuple

from missions.airframe import GRAVITY_M_S2, Airframe, drag_n


class AirState(NamedTuple):
    """State of the point mass: local frame, metres, m/s, radians. V, gamma and chi are relative to the air."""

    x: float
    y: float
    h: float
    V: float
    gamma: float
    chi: float


class Controls(NamedTuple):
    """What the actuators deliver: newtons, newtons, radians (bank positive to the left, towards growing chi)."""

    thrust: float
    lift: float
    bank: float


def point_mass_rates(
    V: float, gamma: float, chi: float, surplus: float, lift_up: float, lift_left: float, mass: float
) -> tuple[float, float, float, float, float, float]:
    """Time derivatives of (x, y, h, V, gamma, chi) in still air, equations (19)-(24), with the dot of (22) restored.

    Args:
        surplus: T - D, newtons.
        lift_up, lift_left: L cos(phi) and L sin(phi), newtons.
    """
    cos_gamma = math.cos(gamma)
    sin_gamma = math.sin(gamma)
    return (
        V * cos_gamma * math.cos(chi),
        V * cos_gamma * math.sin(chi),
        V * sin_gamma,
        surplus / mass - GRAVITY_M_S2 * sin_gamma,
        (lift_up - mass * GRAVITY_M_S2 * cos_gamma) / (mass * V),
        lift_left / (mass * V * cos_gamma),
    )


def rk4_step(
    state: AirState, controls: Controls, wind: tuple[float, float, float], airframe: Airframe, dt: float
) -> AirState:
    """One Runge-Kutta step of the fourth order with controls and wind held.

    Args:
        wind: (east, north, up) m/s.
        dt: step in seconds.
    """
    x, y, h, V, gamma, chi = state
    thrust, lift, bank = controls
    m = airframe.mass_kg
    up = lift * math.cos(bank)
    left = lift * math.sin(bank)
    half = 0.5 * dt
    ax, ay, ah, aV, ag, ac = point_mass_rates(V, gamma, chi, thrust - drag_n(V, lift, airframe), up, left, m)
    v, g, c = V + half * aV, gamma + half * ag, chi + half * ac
    bx, by, bh, bV, bg, bc = point_mass_rates(v, g, c, thrust - drag_n(v, lift, airframe), up, left, m)
    v, g, c = V + half * bV, gamma + half * bg, chi + half * bc
    cx, cy, ch, cV, cg, cc = point_mass_rates(v, g, c, thrust - drag_n(v, lift, airframe), up, left, m)
    v, g, c = V + dt * cV, gamma + dt * cg, chi + dt * cc
    dx, dy, dh, dV, dg, dc = point_mass_rates(v, g, c, thrust - drag_n(v, lift, airframe), up, left, m)
    sixth = dt / 6.0
    return AirState(
        x + sixth * (ax + 2.0 * (bx + cx) + dx) + dt * wind[0],
        y + sixth * (ay + 2.0 * (by + cy) + dy) + dt * wind[1],
        h + sixth * (ah + 2.0 * (bh + ch) + dh) + dt * wind[2],
        V + sixth * (aV + 2.0 * (bV + cV) + dV),
        gamma + sixth * (ag + 2.0 * (bg + cg) + dg),
        chi + sixth * (ac + 2.0 * (bc + cc) + dc),
    )


def air_velocity(state: AirState) -> tuple[float, float, float]:
    """Velocity relative to the air, (east, north, up)."""
    level = state.V * math.cos(state.gamma)
    return level * math.cos(state.chi), level * math.sin(state.chi), state.V * math.sin(state.gamma)


def with_air_velocity(state: AirState, velocity: tuple[float, float, float]) -> AirState:
    """The state with another velocity relative to the air, (east, north, up)."""
    east, north, up = velocity
    level = math.sqrt(east * east + north * north)
    return AirState(
        state.x,
        state.y,
        state.h,
        math.sqrt(level * level + up * up),
        math.atan2(up, level),
        math.atan2(north, east),
    )
