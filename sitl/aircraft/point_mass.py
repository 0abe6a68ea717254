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
    V: float, gamma: float, chi: float, controls: Controls, drag: float, mass: float
) -> tuple[float, float, float, float, float, float]:
    """Time derivatives of (x, y, h, V, gamma, chi) in still air, equations (19)-(24), with the dot of (22) restored."""
    cos_gamma = math.cos(gamma)
    sin_gamma = math.sin(gamma)
    return (
        V * cos_gamma * math.cos(chi),
        V * cos_gamma * math.sin(chi),
        V * sin_gamma,
        (controls.thrust - drag) / mass - GRAVITY_M_S2 * sin_gamma,
        (controls.lift * math.cos(controls.bank) - mass * GRAVITY_M_S2 * cos_gamma) / (mass * V),
        controls.lift * math.sin(controls.bank) / (mass * V * cos_gamma),
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
    m = airframe.mass_kg
    lift = controls.lift
    half = 0.5 * dt
    ax, ay, ah, aV, ag, ac = point_mass_rates(V, gamma, chi, controls, drag_n(V, lift, airframe), m)
    v = V + half * aV
    bx, by, bh, bV, bg, bc = point_mass_rates(
        v, gamma + half * ag, chi + half * ac, controls, drag_n(v, lift, airframe), m
    )
    v = V + half * bV
    cx, cy, ch, cV, cg, cc = point_mass_rates(
        v, gamma + half * bg, chi + half * bc, controls, drag_n(v, lift, airframe), m
    )
    v = V + dt * cV
    dx, dy, dh, dV, dg, dc = point_mass_rates(v, gamma + dt * cg, chi + dt * cc, controls, drag_n(v, lift, airframe), m)
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
