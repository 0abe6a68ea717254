"""Canyons that wind through a fractal plateau, with side canyons that lead nowhere."""

import numpy as np
import numpy.typing as npt

from planner.bench.draft import Draft
from planner.bench.land import fractal_m, level_pad_m, posts_m, raster_terrain, smooth_step
from planner.bench.routes import along_m, winding_m

FloatArray = npt.NDArray[np.float64]

SIZE_XY_M = (34000.0, 20000.0)
HEIGHT_M = (4000.0, 3600.0, 3000.0, 2500.0, 2200.0)
"""The highest that may be flown: over the plateau at first, not in the end."""
PLATEAU_M, RELIEF_M = 1900.0, 500.0
HALF_WIDTH_M = (1500.0, 1300.0, 1100.0, 950.0, 800.0)
"""Of the floor."""
SLOPE_M = 1000.0
"""Across the slope on either side."""
BLIND_PART = 0.55
"""Part of the way after which a blind canyon ends."""


def canyons(rng: np.random.Generator, waypoints: int, level: int) -> Draft:
    """`level` 0 to 4: narrower, more winding, more blind canyons, and no way over the plateau."""
    size = (*SIZE_XY_M, HEIGHT_M[level])
    route = winding_m(rng, size, waypoints, bends=2 + level // 2, sideways=0.12 + 0.03 * level)
    open_m = _openness(route, size, HALF_WIDTH_M[level])
    for _ in range(level):
        blind = winding_m(rng, size, waypoints, bends=3, sideways=rng.uniform(0.1, 0.35))
        blind[0] = route[0]
        end = max(2, round(BLIND_PART * len(blind)))
        open_m = np.maximum(open_m, _openness(blind[:end], size, HALF_WIDTH_M[level]))
    rough = fractal_m(rng, size, RELIEF_M)
    heights = (PLATEAU_M + rough) * (1.0 - open_m) + 0.2 * rough * open_m
    return Draft(
        size_m=size,
        terrain=raster_terrain(level_pad_m(heights, size, route[0])),
        radars=np.empty((0, 5)),
        obstacles=np.empty((0, 4)),
        route_m=route,
        target_above_m=float(np.round(rng.uniform(100.0, 500.0))),
    )


def _openness(route_m: FloatArray, size_m: tuple[float, float, float], half_width_m: float) -> FloatArray:
    """(ny, nx) 1 on a canyon's floor, 0 on the plateau."""
    x, y = posts_m(size_m)
    points = along_m(route_m)[::4]
    distance = np.full((len(y), len(x)), np.inf)
    for point in points:
        distance = np.minimum(distance, np.sqrt((x - point[0]) ** 2 + (y[:, None] - point[1]) ** 2))
    return 1.0 - smooth_step((distance - half_width_m) / SLOPE_M)
