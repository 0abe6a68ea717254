"""The ground: Z = max(Z1, Z2) of equation (2) or a raster of heights, for one point and for arrays.

`ground_height_m` and `ground_height_and_slope` keep to the dialect that plain Python and numba compute bit for bit
alike; endpoints call them as they are, the planner compiles them.
"""

import math
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from missions.environment.raster import (
    NO_POSTS,
    block_tops,
    raster_height_and_slope,
    raster_heights_m,
    raster_slope_bound,
)

FloatArray = npt.NDArray[np.float64]

AIRBORNE_M = 30.0
"""Clearance, exposure and limits count once this height above ground has been passed (MODEL, section 5)."""
NO_WAVE = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)


class Terrain(NamedTuple):
    """Analytic terrain, or with `posts` a raster, which then is all there is.

    Attributes:
        base_m: Z0, the height that the peaks stand on.
        wave: amplitude in metres, then a, b, c, d, e, f, g of the datum wave Z1. The paper gives no values; with
            amplitude 0 there is no wave.
        peaks: one row a peak, (n, 5): height, centre x, centre y, decline x, decline y, all in metres. A list of
            tuples in an endpoint, a float64 array in compiled code.
        posts: heights of a raster, metres, float64 (ny, nx), at least 2 by 2, rows from south to north; (0, 0) when
            there is none.
        x0_m, y0_m: where posts[0, 0] stands, local frame.
        spacing_x_m, spacing_y_m: between neighbouring posts.
        tops: the highest post of each block of the raster, which lets compiled code pass over what is low; filled in
            by `as_array`.
    """

    base_m: float
    wave: tuple[float, float, float, float, float, float, float, float]
    peaks: Any
    posts: FloatArray = NO_POSTS
    x0_m: float = 0.0
    y0_m: float = 0.0
    spacing_x_m: float = 1.0
    spacing_y_m: float = 1.0
    tops: FloatArray = NO_POSTS

    def as_array(self) -> "Terrain":
        """The same terrain with its peaks as a float64 array (n, 5) and its blocks' tops, for compiled code."""
        posts = np.ascontiguousarray(self.posts, dtype=np.float64)
        tops = block_tops(posts) if len(posts) else NO_POSTS
        peaks = np.asarray(self.peaks, dtype=np.float64).reshape(-1, 5)
        return self._replace(peaks=peaks, posts=posts, tops=tops)


def datum_wave_m(x_m: float, y_m: float, wave: tuple[float, float, float, float, float, float, float, float]) -> float:
    """Z1 of equation (2), times its amplitude; the sines take kilometres as in the paper."""
    amplitude_m, a, b, c, d, e, f, g = wave
    x = x_m / 1000.0
    y = y_m / 1000.0
    r = math.sqrt(x * x + y * y)
    shape = (
        math.sin(y + a)
        + b * math.sin(x)
        + c * math.cos(d * r)
        + e * math.cos(x)
        + f * math.sin(f * r)
        + g * math.cos(y)
    )
    return amplitude_m * shape


def datum_wave_slope(
    x_m: float, y_m: float, wave: tuple[float, float, float, float, float, float, float, float]
) -> tuple[float, float]:
    """Derivatives of `datum_wave_m` by x and y; at the origin, where it may have a kink, those of its smooth part."""
    amplitude_m, a, b, c, d, e, f, g = wave
    x = x_m / 1000.0
    y = y_m / 1000.0
    r = math.sqrt(x * x + y * y)
    outward = 0.0
    if r > 0.0:
        outward = (f * f * math.cos(f * r) - c * d * math.sin(d * r)) / r
    slope_x = b * math.cos(x) - e * math.sin(x) + outward * x
    slope_y = math.cos(y + a) - g * math.sin(y) + outward * y
    return amplitude_m * slope_x / 1000.0, amplitude_m * slope_y / 1000.0


def ground_height_m(x_m: float, y_m: float, terrain: Terrain) -> float:
    """Height of the ground above the datum at one point, metres."""
    if len(terrain.posts) > 0:
        return raster_height_and_slope(x_m, y_m, terrain)[0]
    return analytic_height_m(x_m, y_m, terrain.base_m, terrain.wave, terrain.peaks)


def analytic_height_m(
    x_m: float,
    y_m: float,
    base_m: float,
    wave: tuple[float, float, float, float, float, float, float, float],
    peaks: Any,
) -> float:
    """The same where there is no raster (equation (2)), of the fields of a terrain."""
    height = base_m
    for i in range(len(peaks)):
        peak = peaks[i]
        u = (x_m - peak[1]) / peak[3]
        v = (y_m - peak[2]) / peak[4]
        exponent = u * u + v * v
        if exponent < 25.0:  # beyond, a peak of 1 km adds less than 2e-8 m
            height += peak[0] * math.exp(-exponent)
    if wave[0] != 0.0:
        height = max(height, datum_wave_m(x_m, y_m, wave))
    return height


def ground_height_and_slope(x_m: float, y_m: float, terrain: Terrain) -> tuple[float, float, float]:
    """Height of the ground at one point, metres, exactly as `ground_height_m`, and its derivatives by x and y."""
    if len(terrain.posts) > 0:
        return raster_height_and_slope(x_m, y_m, terrain)
    height = terrain.base_m
    slope_x = 0.0
    slope_y = 0.0
    for i in range(len(terrain.peaks)):
        peak = terrain.peaks[i]
        u = (x_m - peak[1]) / peak[3]
        v = (y_m - peak[2]) / peak[4]
        exponent = u * u + v * v
        if exponent < 25.0:
            here = peak[0] * math.exp(-exponent)
            height += here
            slope_x -= 2.0 * here * u / peak[3]
            slope_y -= 2.0 * here * v / peak[4]
    if terrain.wave[0] != 0.0:
        wave_m = datum_wave_m(x_m, y_m, terrain.wave)
        if wave_m > height:
            height = wave_m
            slope_x, slope_y = datum_wave_slope(x_m, y_m, terrain.wave)
    return height, slope_x, slope_y


def ground_heights_m(x_m: FloatArray, y_m: FloatArray, terrain: Terrain) -> FloatArray:
    """Heights of the ground at arrays of points of any one shape, metres (equation (2)); vectorised with numpy."""
    if len(terrain.posts):
        return raster_heights_m(x_m, y_m, terrain)
    height = np.full(np.broadcast(x_m, y_m).shape, terrain.base_m)
    for peak_m, centre_x, centre_y, decline_x, decline_y in terrain.peaks:
        height += peak_m * np.exp(-(((x_m - centre_x) / decline_x) ** 2) - ((y_m - centre_y) / decline_y) ** 2)
    amplitude_m, a, b, c, d, e, f, g = terrain.wave
    if amplitude_m == 0.0:
        return height
    x, y = x_m / 1000.0, y_m / 1000.0
    r = np.hypot(x, y)
    wave = np.sin(y + a) + b * np.sin(x) + c * np.cos(d * r) + e * np.cos(x) + f * np.sin(f * r) + g * np.cos(y)
    highest: FloatArray = np.maximum(height, amplitude_m * wave)
    return highest


def slope_bound(terrain: Terrain) -> float:
    """No point of the ground is steeper: an upper bound of |grad Z| everywhere, exact for a raster.

    A peak is steepest at 1/sqrt(2) of its decline: h / decline * sqrt(2 / e).
    """
    if len(terrain.posts):
        return raster_slope_bound(terrain)
    steepest = math.sqrt(2.0 / math.e)
    peaks = sum(abs(peak[0]) / min(peak[3], peak[4]) * steepest for peak in terrain.peaks)
    amplitude_m, _, b, c, d, e, f, g = terrain.wave
    wave = abs(amplitude_m) / 1000.0 * (1.0 + abs(b) + abs(c * d) + abs(e) + f * f + abs(g))
    return float(max(peaks, wave))
