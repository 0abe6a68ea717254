"""The radar cost of one leg (7)-(8), as a line integral in closed form."""

import math
from typing import Any

from missions.compiled import jit
from missions.environment.radars import CORE

LEAST_PASS = 3e-4
"""Legs that pass the centre closer than this many radii count as passing at it: an error of 1e-5 at most, where the
closed form loses its digits."""


@jit
def radar_integral_m(p: Any, q: Any, radar: Any) -> float:
    """Integral of (delta / D)^4 along the leg from p to q, where D <= R; metres (equations (7)-(8)).

    With rho the distance of the leg's line from the centre and s the length along it from the nearest point,
    D^2 = rho^2 + s^2, and the antiderivative of D^-4 is s / (2 rho^2 D^2) + atan(s / rho) / (2 rho^3). D counts as
    no less than `CORE` R.
    """
    radius = radar[3]
    dx, dy, dz = q[0] - p[0], q[1] - p[1], q[2] - p[2]
    cx, cy, cz = radar[0] - p[0], radar[1] - p[1], radar[2] - p[2]
    length = math.sqrt(dx * dx + dy * dy + dz * dz)
    if length == 0.0:
        return 0.0
    along = (cx * dx + cy * dy + cz * dz) / length
    rho2 = max(0.0, cx * cx + cy * cy + cz * cz - along * along)
    if rho2 >= radius * radius:
        return 0.0
    reach = math.sqrt(radius * radius - rho2)
    start, end = max(-along, -reach), min(length - along, reach)
    if start >= end:
        return 0.0
    core = CORE * radius
    half_core = math.sqrt(max(0.0, core * core - rho2))
    rho = max(math.sqrt(rho2), LEAST_PASS * radius)
    total: float = max(0.0, min(end, half_core) - max(start, -half_core)) / (core * core * core * core)
    total += _outside_core(max(start, half_core), end, rho) + _outside_core(max(-end, half_core), -start, rho)
    delta2: float = radar[4] * radar[4]
    return total * delta2 * delta2


@jit
def _outside_core(s0: float, s1: float, rho: float) -> float:
    if s0 >= s1:
        return 0.0
    rho2 = rho * rho
    rational = s1 / (rho2 + s1 * s1) - s0 / (rho2 + s0 * s0)
    return (rational + (math.atan(s1 / rho) - math.atan(s0 / rho)) / rho) / (2.0 * rho2)
