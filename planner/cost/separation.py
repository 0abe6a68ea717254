"""How near two UAVs come in time, exactly: all leave and arrive together and make even progress along their paths."""

import math
from typing import Any

from missions.compiled import jit


@jit
def least_separation_m(p: Any, q: Any, start: float, end: float, other: Any, first: int) -> tuple[float, float, int]:
    """Least distance between a UAV on its leg from p to q and another UAV at the same time, metres.

    Args:
        start, end: parts of the flight at which p and q are passed.
        other: (m, 4) corners of the other path and the part of the flight after which each is passed.
        first: a leg of the other path that begins no later than `start`.

    Returns:
        The distance, the part of the flight after which it is reached, and the other's leg at `end`, where the search
        for the next leg begins.

    Between corners of either path the relative motion is a straight line.
    """
    least2 = math.inf
    nearest = start
    leg = first
    last = len(other) - 2
    u0 = start
    while True:
        u1 = end if leg == last else min(end, other[leg + 1, 3])
        if u1 >= u0:
            x0, y0, z0 = _offset(p, q, start, end, other, leg, u0)
            x1, y1, z1 = _offset(p, q, start, end, other, leg, u1)
            dx, dy, dz = x1 - x0, y1 - y0, z1 - z0
            moved2 = dx * dx + dy * dy + dz * dz
            t = min(1.0, max(0.0, -(x0 * dx + y0 * dy + z0 * dz) / moved2)) if moved2 > 0.0 else 0.0
            x, y, z = x0 + t * dx, y0 + t * dy, z0 + t * dz
            distance2 = x * x + y * y + z * z
            if distance2 < least2:
                least2, nearest = distance2, u0 + t * (u1 - u0)
            u0 = u1
        if leg == last or other[leg + 1, 3] >= end:
            return math.sqrt(least2), nearest, leg
        leg += 1


@jit
def _offset(p: Any, q: Any, start: float, end: float, other: Any, leg: int, u: float) -> tuple[float, float, float]:
    """Where this UAV is relative to the other one after the part u of the flight."""
    a = (u - start) / max(end - start, 1e-12)
    b = (u - other[leg, 3]) / max(other[leg + 1, 3] - other[leg, 3], 1e-12)
    return (
        p[0] + a * (q[0] - p[0]) - other[leg, 0] - b * (other[leg + 1, 0] - other[leg, 0]),
        p[1] + a * (q[1] - p[1]) - other[leg, 1] - b * (other[leg + 1, 1] - other[leg, 1]),
        p[2] + a * (q[2] - p[2]) - other[leg, 2] - b * (other[leg + 1, 2] - other[leg, 2]),
    )
