"""How the least height of a leg above ground changes as its ends move."""

from typing import Any

from missions.compiled import compile_shared, jit
from missions.environment.terrain import ground_height_and_slope

ground = compile_shared(ground_height_and_slope)

SEAM_M = 1e-6
"""As near as this to a seam of a raster's cells, or to the end of the climb-out, counts as there."""


@jit
def add_height_slope(
    p: Any, q: Any, t: float, wanted: float, weight: float, terrain: Any, at_p: Any, at_q: Any
) -> None:
    """Add a slope in the least height of the leg from p to q above ground, to the slopes in p and in q.

    Args:
        t: the part of the leg at which it is reached.
        wanted: by how much more height is asked for at q than at p, when height counts beyond that; metres.
        weight: the slope.
    """
    slope_x, slope_y = _ground_slope(p, q, t, q[2] - p[2] - wanted, terrain)
    for end in range(2):
        share = weight * (t if end else 1.0 - t)
        slope = at_q if end else at_p
        slope[0] -= share * slope_x
        slope[1] -= share * slope_y
        slope[2] += share


@jit
def ramp_slope(p: Any, q: Any, t: float, left_m: float, arc_m: float, bounds: Any, terrain: Any) -> float:
    """By how much more clearance is wanted a metre of way at the part t of a leg, at which most is missing.

    Args:
        left_m: of the climb-out from there on.
        arc_m: length of the leg.

    Right at the end of the climb-out, as much as the leg rises above the ground there: that place moves with it.
    """
    if abs(left_m) < SEAM_M and 0.0 < t < 1.0:
        dx, dy = q[0] - p[0], q[1] - p[1]
        _, slope_x, slope_y = ground(p[0] + t * dx, p[1] + t * dy, terrain)
        climb: float = (q[2] - p[2] - slope_x * dx - slope_y * dy) / arc_m
        return climb
    ramp: float = bounds.clearance_m / bounds.climb_out_m
    return ramp if left_m > 0.0 else 0.0


@jit
def _ground_slope(p: Any, q: Any, t: float, rise: float, terrain: Any) -> tuple[float, float]:
    """The ground's slopes under the place at the part t of a leg at which a line that rises by `rise` a leg is nearest
    above it.

    On a seam between two cells of a raster the slope across jumps: from less along the leg than the line's to more.
    Where the leg is moved, the nearest place stays on the seam: what counts is the slope in between that is the line's.
    """
    dx, dy = q[0] - p[0], q[1] - p[1]
    x, y = p[0] + t * dx, p[1] + t * dy
    _, slope_x, slope_y = ground(x, y, terrain)
    if len(terrain.posts) > 0 and 0.0 < t < 1.0:
        if dx != 0.0 and _on_seam(x, terrain.x0_m, terrain.spacing_x_m):
            _, before, _ = ground(x - SEAM_M, y, terrain)
            _, after, _ = ground(x + SEAM_M, y, terrain)
            slope_x = min(max((rise - slope_y * dy) / dx, min(before, after)), max(before, after))
        elif dy != 0.0 and _on_seam(y, terrain.y0_m, terrain.spacing_y_m):
            _, _, before = ground(x, y - SEAM_M, terrain)
            _, _, after = ground(x, y + SEAM_M, terrain)
            slope_y = min(max((rise - slope_x * dx) / dy, min(before, after)), max(before, after))
    return slope_x, slope_y


@jit
def _on_seam(position_m: float, first_m: float, spacing_m: float) -> bool:
    cells = (position_m - first_m) / spacing_m
    return abs(cells - round(cells)) * spacing_m < SEAM_M
