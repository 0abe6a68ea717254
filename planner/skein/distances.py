"""How far a leg is from things, and where on the leg: what a distance needs for its gradient.

The least distance over a leg is d = |p + t (q - p) - c| at some t. As t is the best there is, d's gradient is that of
the distance at a fixed t (Danskin): (1 - t) n for p and t n for q, n being the unit vector away from c.
"""

import math
from typing import Any

from missions.compiled import jit
from planner.cost.obstacles import wall_distance_and_place

TOUCHING_M = 1e-9
RIM_M = 1e-3
"""Inside an obstacle, side and top this equally far away: the nearest place is where they change places."""


@jit
def sphere_distance(p: Any, q: Any, x: float, y: float, z: float) -> tuple[float, float, float, float, float]:
    """Least distance of the leg from p to q to a point, metres; t; and n (3)."""
    dx, dy, dz = q[0] - p[0], q[1] - p[1], q[2] - p[2]
    cx, cy, cz = x - p[0], y - p[1], z - p[2]
    length2 = dx * dx + dy * dy + dz * dz
    t = min(1.0, max(0.0, (cx * dx + cy * dy + cz * dz) / length2)) if length2 > 0.0 else 0.0
    nx, ny, nz = t * dx - cx, t * dy - cy, t * dz - cz
    distance = max(math.sqrt(nx * nx + ny * ny + nz * nz), TOUCHING_M)
    return distance, t, nx / distance, ny / distance, nz / distance


@jit
def wall_distance(p: Any, q: Any, obstacle: Any, reach_m: float) -> tuple[float, float, float, float, float]:
    """Least signed distance of the leg from p to q to an obstacle's surface, metres, infinite when it is more than
    `reach_m`; t; and n (3)."""
    distance, t = wall_distance_and_place(p, q, obstacle, reach_m)
    if distance == math.inf:
        return distance, t, 0.0, 0.0, 0.0
    nx, ny = p[0] + t * (q[0] - p[0]) - obstacle[0], p[1] + t * (q[1] - p[1]) - obstacle[1]
    from_axis = max(math.sqrt(nx * nx + ny * ny), TOUCHING_M)
    beside, above = from_axis - obstacle[2], p[2] + t * (q[2] - p[2]) - obstacle[3]
    if above <= 0.0 or (beside > 0.0 and beside >= 1e3 * above):
        sideways, upwards = (1.0, 0.0) if beside >= above else (0.0, 1.0)
        outwards, rise = (nx * (q[0] - p[0]) + ny * (q[1] - p[1])) / from_axis, q[2] - p[2]
        if abs(beside - above) < RIM_M and outwards * rise < 0.0:
            # The larger of two distances is least where they cross: along the leg their mean must not change.
            sideways, upwards = rise / (rise - outwards), outwards / (outwards - rise)
    elif beside <= 0.0:
        sideways, upwards = 0.0, 1.0
    else:
        slant = math.sqrt(beside * beside + above * above)
        sideways, upwards = beside / slant, above / slant
    return distance, t, sideways * nx / from_axis, sideways * ny / from_axis, upwards
