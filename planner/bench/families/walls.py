"""Walls from side to side and higher than may be flown, each with one gap: 1 of them to 5."""

import numpy as np
import numpy.typing as npt

from planner.bench.draft import WALL_M, Draft
from planner.bench.land import flat_terrain
from planner.bench.routes import stations_m

FloatArray = npt.NDArray[np.float64]

WIDTH_M, HEIGHT_M = 18000.0, 3000.0
APART_M = 12000.0
"""Between two walls."""
TOP_M = 4000.0
RADIUS_M = 600.0
"""A wall is a row of cylinders that overlap."""
PITCH_M = 1000.0
GAP_M = (1500.0, 1200.0, 900.0, 700.0, 500.0)
"""Between what must be kept from the two ends of a wall."""
SIDEWAYS = 0.1, 0.18
"""Least and largest offset of a gap from the middle, in widths of the area, left and right in turn."""


def walls(rng: np.random.Generator, waypoints: int, level: int) -> Draft:
    """`level` 0 to 4: more walls and narrower gaps, as far as there are waypoints to pass them with."""
    count = min(level + 1, max(1, waypoints // 4))
    size = (APART_M * (count + 1), WIDTH_M, HEIGHT_M)
    x = stations_m(size[0], waypoints)
    through = np.round((np.arange(count) + 1) * (waypoints + 1) / (count + 1)).astype(np.int64)
    side = rng.choice([-1.0, 1.0]) * (-1.0) ** np.arange(count)
    gaps = np.round(WIDTH_M * (0.5 + side * rng.uniform(*SIDEWAYS, count)))
    middle = 0.5 * WIDTH_M
    # Straight from gap to gap: where the route bends it is in a gap.
    y = np.round(np.interp(x, x[[0, *through, -1]], [middle, *gaps, middle]))
    return Draft(
        size_m=size,
        terrain=flat_terrain(),
        radars=np.empty((0, 5)),
        obstacles=np.vstack([_wall(x[k], gap, GAP_M[level]) for k, gap in zip(through, gaps, strict=True)]),
        route_m=np.column_stack([x, y]),
        target_above_m=float(np.round(rng.uniform(200.0, 900.0))),
    )


def _wall(x_m: float, gap_m: float, width_m: float) -> FloatArray:
    """(n, 4) the cylinders of one wall."""
    beside = 0.5 * width_m + WALL_M + RADIUS_M
    left = np.arange(gap_m + beside, WIDTH_M + RADIUS_M, PITCH_M)
    right = np.arange(gap_m - beside, -RADIUS_M, -PITCH_M)
    y = np.concatenate([right[::-1], left])
    return np.column_stack([np.full_like(y, x_m), y, np.full_like(y, RADIUS_M), np.full_like(y, TOP_M)])
