"""How high legs pass above the ground, in plain numpy: peaks by the kernel's samples, a raster cell by cell."""

import numpy as np
import numpy.typing as npt

from missions.environment import Terrain, ground_heights_m
from missions.environment.raster import raster_heights_m
from planner.cost.problem import Bounds
from planner.cost.terrain import DIP_M

FloatArray = npt.NDArray[np.float64]

RAMP_STEP_M = 100.0
"""Between samples where the wanted clearance still grows."""


def clearances_m(
    corners: FloatArray, passed: FloatArray, terrain: Terrain, bounds: Bounds
) -> tuple[FloatArray, FloatArray]:
    """Least clearance and largest shortfall (n, legs), as `planner.cost.terrain.leg_clearance_m` gives them.

    Args:
        corners: (n, legs + 1, 3).
        passed: (n, legs + 1) length of the path before each corner.
    """
    t = (
        _crossings(corners, passed, terrain, bounds)
        if len(terrain.posts)
        else _samples(corners, passed, terrain, bounds)
    )
    p, leg = corners[:, :-1, None], np.diff(corners, axis=1)[:, :, None]
    climbed = passed[:, :-1, None] + t * np.diff(passed, axis=1)[:, :, None]
    wanted = bounds.clearance_m * np.minimum(1.0, climbed / bounds.climb_out_m)
    x, y, z = np.moveaxis(p + t[..., None] * leg, -1, 0)
    if not len(terrain.posts):
        clearance = z - ground_heights_m(x, y, terrain)
        return clearance.min(axis=2), (wanted - clearance).max(axis=2)
    above = z - raster_heights_m(x, y, terrain)
    middle = 0.5 * (t[:, :, 1:] + t[:, :, :-1])
    xm, ym, zm = np.moveaxis(p + middle[..., None] * leg, -1, 0)
    at_middle = zm - raster_heights_m(xm, ym, terrain)
    wanted_middle = 0.5 * (wanted[:, :, 1:] + wanted[:, :, :-1])
    least = _least_of_quadratics(above, at_middle)
    return least, -_least_of_quadratics(above - wanted, at_middle - wanted_middle)


def _samples(corners: FloatArray, passed: FloatArray, terrain: Terrain, bounds: Bounds) -> FloatArray:
    """(n, legs, most) parts of the legs to look at: so many that nothing between them dips by more than `DIP_M`."""
    p, d = corners[:, :-1], np.diff(corners, axis=1)
    bend = np.zeros(d.shape[:2])
    for height, centre_x, centre_y, decline_x, decline_y in terrain.peaks:
        u, v = (p[:, :, 0] - centre_x) / decline_x, (p[:, :, 1] - centre_y) / decline_y
        du, dv = d[:, :, 0] / decline_x, d[:, :, 1] / decline_y
        speed2 = du**2 + dv**2
        t = np.clip(-(u * du + v * dv) / np.maximum(speed2, 1e-300), 0.0, 1.0)
        exponent = (u + t * du) ** 2 + (v + t * dv) ** 2
        rim = np.maximum(1.0, exponent)
        curve = 2.0 * height * np.exp(-exponent) if height >= 0.0 else -4.0 * height * rim * np.exp(-rim)
        bend += np.where(exponent <= 40.0, speed2 * curve, 0.0)
    steps = np.sqrt(bend / (8.0 * DIP_M)).astype(np.int64) + 1
    ramp = (np.diff(passed, axis=1) / RAMP_STEP_M).astype(np.int64) + 1
    steps = np.where(passed[:, :-1] < bounds.climb_out_m, np.maximum(steps, ramp), steps)
    # Legs that need fewer samples than the neediest repeat their end.
    return np.minimum(np.arange(int(steps.max()) + 1) / steps[:, :, None], 1.0)


def _crossings(corners: FloatArray, passed: FloatArray, terrain: Terrain, bounds: Bounds) -> FloatArray:
    """(n, legs, most) parts of the legs, ascending, between which the ground is one quadratic: both ends, the lines of
    posts that are crossed, and the end of the ramp of the wanted clearance."""
    legs = corners.shape[1] - 1
    found = [np.zeros((len(corners), legs, 1)), np.ones((len(corners), legs, 1))]
    grid = ((terrain.x0_m, terrain.spacing_x_m), (terrain.y0_m, terrain.spacing_y_m))
    for axis, (first_m, spacing_m) in enumerate(grid):
        u = (corners[:, :, axis] - first_m) / spacing_m
        low, high = np.minimum(u[:, :-1], u[:, 1:]), np.maximum(u[:, :-1], u[:, 1:])
        du = np.diff(u, axis=1)
        lines = np.ceil(low)[:, :, None] + np.arange(int((np.floor(high) - np.ceil(low)).max()) + 1)
        t = (lines - u[:, :-1, None]) / np.where(du == 0.0, 1.0, du)[:, :, None]
        found.append(np.clip(np.where(lines <= high[:, :, None], t, 1.0), 0.0, 1.0))
    length = np.maximum(np.diff(passed, axis=1), 1e-300)
    found.append(np.clip((bounds.climb_out_m - passed[:, :-1]) / length, 0.0, 1.0)[:, :, None])
    return np.sort(np.concatenate(found, axis=2), axis=2)


def _least_of_quadratics(at_ends: FloatArray, at_middles: FloatArray) -> FloatArray:
    """(n, legs) least value of quadratics known at the ends (n, legs, k + 1) and the middles (n, legs, k) of pieces."""
    y0, y1 = at_ends[:, :, :-1], at_ends[:, :, 1:]
    curve = 2.0 * (y0 + y1 - 2.0 * at_middles)
    rate = y1 - y0 - curve
    bent = (curve > 0.0) & (rate < 0.0) & (rate + 2.0 * curve > 0.0)
    vertex = y0 - rate**2 / (4.0 * np.where(bent, curve, 1.0))
    least: FloatArray = np.minimum(np.where(bent, vertex, np.inf).min(axis=2), at_ends.min(axis=2))
    return least
