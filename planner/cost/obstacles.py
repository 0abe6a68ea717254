"""How near a leg comes to an obstacle, exactly."""

import math
from typing import Any

from missions.compiled import jit

GOLDEN = 0.6180339887498949
STEPS = 40
"""Golden-section steps: the leg is narrowed down to 4e-9 of itself."""


@jit
def least_wall_distance_m(p: Any, q: Any, obstacle: Any) -> float:
    """Least signed distance of the leg from p to q to an obstacle's surface, metres; negative inside.

    Infinite as soon as it is known to be more than the distance to keep, obstacle[4].
    """
    least: float = wall_distance_and_place(p, q, obstacle, obstacle[4])[0]
    return least


@jit
def wall_distance_and_place(p: Any, q: Any, obstacle: Any, reach_m: float) -> tuple[float, float]:
    """`least_wall_distance_m`, and the part of the leg after which it is reached.

    Infinite as soon as it is known to be more than `reach_m`. The signed distance to a convex
    body is convex along a line: a golden-section search cannot be led astray where the closed forms, beside the wall
    and above the top, do not settle it.
    """
    dx, dy, dz = q[0] - p[0], q[1] - p[1], q[2] - p[2]
    ax, ay = obstacle[0] - p[0], obstacle[1] - p[1]
    across2 = dx * dx + dy * dy
    nearest = min(1.0, max(0.0, (ax * dx + ay * dy) / across2)) if across2 > 0.0 else 0.0
    x, y = nearest * dx - ax, nearest * dy - ay
    beside = math.sqrt(x * x + y * y) - obstacle[2]
    lowest = 0.0 if dz >= 0.0 else 1.0
    above = p[2] + lowest * dz - obstacle[3]
    if max(beside, above) > reach_m:
        return math.inf, nearest
    if p[2] + nearest * dz - obstacle[3] <= min(beside, 0.0):
        return beside, nearest
    x, y = lowest * dx - ax, lowest * dy - ay
    if math.sqrt(x * x + y * y) - obstacle[2] <= min(above, 0.0):
        return above, lowest
    low, high = 0.0, 1.0
    t0, t1 = 1.0 - GOLDEN, GOLDEN
    d0 = _signed_distance_m(t0 * dx - ax, t0 * dy - ay, p[2] + t0 * dz, obstacle)
    d1 = _signed_distance_m(t1 * dx - ax, t1 * dy - ay, p[2] + t1 * dz, obstacle)
    for _ in range(STEPS):
        if d0 <= d1:
            high, t1, d1 = t1, t0, d0
            t0 = high - GOLDEN * (high - low)
            d0 = _signed_distance_m(t0 * dx - ax, t0 * dy - ay, p[2] + t0 * dz, obstacle)
        else:
            low, t0, d0 = t0, t1, d1
            t1 = low + GOLDEN * (high - low)
            d1 = _signed_distance_m(t1 * dx - ax, t1 * dy - ay, p[2] + t1 * dz, obstacle)
    return (d0, t0) if d0 <= d1 else (d1, t1)


@jit
def _signed_distance_m(x_m: float, y_m: float, z_m: float, obstacle: Any) -> float:
    """Signed distance of a point, whose x and y count from the axis."""
    beside = math.sqrt(x_m * x_m + y_m * y_m) - obstacle[2]
    above = z_m - obstacle[3]
    distance: float = max(beside, above)
    if beside > 0.0 and above > 0.0:
        distance = math.sqrt(beside * beside + above * above)
    return distance
