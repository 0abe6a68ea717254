"""How much the ground may rise and bend within a disc: what clearance between two samples is bounded by."""

import math
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from missions.environment import Terrain
from missions.environment.terrain import slope_bound

FloatArray = npt.NDArray[np.float64]


class GroundBounds(NamedTuple):
    """Over discs, (n,): the largest |grad Z|, and the largest curvature downwards of any section through it."""

    slope: FloatArray
    bend: FloatArray


def ground_bounds(x_m: FloatArray, y_m: FloatArray, radius_m: FloatArray, terrain: Terrain) -> GroundBounds:
    """Bounds over discs about points (n,).

    A raster's cells meet in edges, and the datum wave may have kinks: there only the slope is bounded, by what it is
    anywhere. A peak h exp(-u^2), u in units of its declines d, has the slope h / d * 2 u exp(-u^2), largest at
    1/sqrt(2), and sections that bend downwards by at most 2 h / d^2 exp(-u^2); a hollow, on its rim, by at most
    4 h / d^2 u^2 exp(-u^2), largest at 1. The smaller decline stands for both.
    """
    if len(terrain.posts) or terrain.wave[0] != 0.0:
        return GroundBounds(np.full(len(x_m), slope_bound(terrain)), np.full(len(x_m), np.inf))
    slope, bend = np.zeros(len(x_m)), np.zeros(len(x_m))
    for height, centre_x, centre_y, decline_x, decline_y in terrain.peaks:
        decline = min(decline_x, decline_y)
        u = np.hypot((x_m - centre_x) / decline_x, (y_m - centre_y) / decline_y)
        low, high = np.maximum(u - radius_m / decline, 0.0), u + radius_m / decline
        steepest = np.clip(math.sqrt(0.5), low, high)
        slope += abs(height) / decline * 2.0 * steepest * np.exp(-(steepest**2))
        rim = np.maximum(low, 1.0)
        sharpest = np.exp(-(low**2)) if height >= 0.0 else 2.0 * rim**2 * np.exp(-(rim**2))
        bend += 2.0 * abs(height) / decline**2 * sharpest
    return GroundBounds(slope, bend)
