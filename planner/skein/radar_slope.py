"""How the radar cost of a leg changes as its ends move: the gradient of (7)-(8)."""

import math
from typing import Any

import numpy as np

from missions.environment.radars import CORE
from planner.compiled import jit

_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(12)


@jit
def add_radar_slope(p: Any, q: Any, radar: Any, slope_p: Any, slope_q: Any) -> None:
    """Add the gradient of `radar_integral_m` in p and in q, metres a metre.

    Under the integral by Gauss quadrature over the part within the radius; where the leg enters or leaves the sphere,
    that point P moves by -P dP / reach along the leg, reach = sqrt(R^2 - rho^2).
    """
    radius = radar[3]
    dx, dy, dz = q[0] - p[0], q[1] - p[1], q[2] - p[2]
    length = math.sqrt(dx * dx + dy * dy + dz * dz)
    if length < 1e-3:
        return
    ux, uy, uz = dx / length, dy / length, dz / length
    cx, cy, cz = radar[0] - p[0], radar[1] - p[1], radar[2] - p[2]
    along = cx * ux + cy * uy + cz * uz
    rho2 = max(0.0, cx * cx + cy * cy + cz * cz - along * along)
    if rho2 >= radius * radius:
        return
    reach = max(math.sqrt(radius * radius - rho2), 1e-2 * radius)
    start, end = max(-along, -reach), min(length - along, reach)
    if start >= end:
        return
    strength = radar[4] * radar[4] * radar[4] * radar[4]
    core2 = CORE * radius * CORE * radius
    # Split at the nearest point, where the density peaks.
    for piece in range(2):
        low, high = (start, min(end, max(start, 0.0))) if piece == 0 else (min(end, max(start, 0.0)), end)
        half = 0.5 * (high - low)
        if half <= 0.0:
            continue
        for i in range(len(_NODES)):
            s = low + half * (1.0 + _NODES[i])
            t = (s + along) / length
            weight = half * _WEIGHTS[i] * strength
            x, y, z = p[0] + t * dx - radar[0], p[1] + t * dy - radar[1], p[2] + t * dz - radar[2]
            distance2 = x * x + y * y + z * z
            density = weight / (max(distance2, core2) * max(distance2, core2))
            stretch = density / length
            fall = -4.0 * density / distance2 if distance2 > core2 else 0.0
            for axis in range(3):
                unit = ux if axis == 0 else uy if axis == 1 else uz
                away = x if axis == 0 else y if axis == 1 else z
                slope_p[axis] += (1.0 - t) * fall * away - stretch * unit
                slope_q[axis] += t * fall * away + stretch * unit
    edge = strength / (radius * radius * radius * radius) / reach
    for side in range(2):
        if (start if side == 0 else -end) > -reach:
            continue  # that end lies inside
        t = (along - reach if side == 0 else along + reach) / length
        for axis in range(3):
            away = p[axis] + t * (q[axis] - p[axis]) - radar[axis]
            slope_p[axis] -= edge * (1.0 - t) * away
            slope_q[axis] -= edge * t * away
