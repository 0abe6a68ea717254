"""How the radar cost of a leg changes as its ends move: the gradient of (7)-(8), in closed form."""

import math
from typing import Any

from missions.compiled import jit
from missions.environment.radars import CORE

GRAZING = 1e-2
"""Half of a leg's part within the radius counts as so many radii at least: the slope is infinite where a leg touches
the sphere."""
FAR = 4.0
"""In distances of the line from the centre: beyond, a series keeps the digits that the closed form loses."""
TERMS = 10


@jit
def add_radar_slope(p: Any, q: Any, radar: Any, slope_p: Any, slope_q: Any) -> None:
    """Add the gradient of `radar_integral_m` in p and in q, metres a metre.

    With the names of `radar_integral_m`, the integral depends on rho^2, by which D^-4 falls as -2 D^-6 everywhere
    outside the core; on where along its line the leg begins and ends, if that is inside the radius; and otherwise on
    reach = sqrt(R^2 - rho^2). As the line's ends move, so does its point nearest the centre, by (1 - t) dp + t dq.
    """
    radius = radar[3]
    dx, dy, dz = q[0] - p[0], q[1] - p[1], q[2] - p[2]
    length = math.sqrt(dx * dx + dy * dy + dz * dz)
    if length < 1e-3:
        return
    ux, uy, uz = dx / length, dy / length, dz / length
    cx, cy, cz = radar[0] - p[0], radar[1] - p[1], radar[2] - p[2]
    along = cx * ux + cy * uy + cz * uz
    wx, wy, wz = cx - along * ux, cy - along * uy, cz - along * uz
    rho2 = wx * wx + wy * wy + wz * wz
    if rho2 >= radius * radius:
        return
    reach = math.sqrt(radius * radius - rho2)
    start, end = max(-along, -reach), min(length - along, reach)
    if start >= end:
        return
    core2 = CORE * radius * CORE * radius
    half_core = math.sqrt(max(0.0, core2 - rho2))
    by_rho2 = -2.0 * _sixth_power(max(start, half_core), end, rho2)
    by_rho2 -= 2.0 * _sixth_power(max(-end, half_core), -start, rho2)
    at_p = at_q = 0.0  # density at an end that lies inside
    edge = 1.0 / (2.0 * radius * radius * radius * radius * max(reach, GRAZING * radius))
    if start > -reach:
        at_p = 1.0 / max(rho2 + start * start, core2) ** 2
    else:
        by_rho2 -= edge
    if end < reach:
        at_q = 1.0 / max(rho2 + end * end, core2) ** 2
    else:
        by_rho2 -= edge

    strength = radar[4] * radar[4] * radar[4] * radar[4]
    t = along / length
    inwards_p = strength * (-2.0 * (1.0 - t) * by_rho2 - (at_p - at_q) / length)
    inwards_q = strength * (-2.0 * t * by_rho2 + (at_p - at_q) / length)
    slope_p[0] += inwards_p * wx - strength * at_p * ux
    slope_p[1] += inwards_p * wy - strength * at_p * uy
    slope_p[2] += inwards_p * wz - strength * at_p * uz
    slope_q[0] += inwards_q * wx + strength * at_q * ux
    slope_q[1] += inwards_q * wy + strength * at_q * uy
    slope_q[2] += inwards_q * wz + strength * at_q * uz


@jit
def _sixth_power(s0: float, s1: float, rho2: float) -> float:
    """Integral of D^-6 from s0 >= 0 to s1: s / (4 rho^2 D^4) + 3 / (4 rho^2) times that of D^-4; or by powers of
    rho^2 / s^2."""
    if s0 >= s1:
        return 0.0
    total = 0.0
    if s0 * s0 > FAR * FAR * rho2:
        power0, power1 = 1.0 / (s0 * s0 * s0 * s0 * s0), 1.0 / (s1 * s1 * s1 * s1 * s1)
        for n in range(TERMS):
            total += 0.5 * (n + 1) * (n + 2) * (power0 - power1) / (5 + 2 * n)
            power0 *= -rho2 / (s0 * s0)
            power1 *= -rho2 / (s1 * s1)
        return total
    rho = math.sqrt(rho2)
    for s, sign in ((s0, -1.0), (s1, 1.0)):
        distance2 = rho2 + s * s
        fourth = (s / distance2 + math.atan(s / rho) / rho) / (2.0 * rho2)
        total += sign * (s / (distance2 * distance2) + 3.0 * fourth) / (4.0 * rho2)
    return total
