"""The ground: Z = max(Z1, Z2) of equation (2), for one point and for arrays.

`ground_height_m` keeps to the dialect that plain Python and numba compute bit for bit alike; endpoints call it as
it is, the planner compiles it.
"""

import math
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.float64]

AIRBORNE_M = 30.0
"""Clearance, exposure and limits count once this height above ground has been passed (MODEL, section 5)."""
NO_WAVE = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)


class Terrain(NamedTuple):
    """Analytic terrain.

    Attributes:
        base_m: Z0, the height that the peaks stand on.
        wave: amplitude in metres, then a, b, c, d, e, f, g of the datum wave Z1. The paper gives no values; with
            amplitude 0 there is no wave.
        peaks: one row a peak, (n, 5): height, centre x, centre y, decline x, decline y, all in metres. A list of
            tuples in an endpoint, a float64 array in compiled code.
    """

    base_m: float
    wave: tuple[float, float, float, float, float, float, float, float]
    peaks: Any

    def as_array(self) -> "Terrain":
        """The same terrain with its peaks as a float64 array (n, 5), for compiled and vectorised code."""
        return self._replace(peaks=np.asarray(self.peaks, dtype=np.float64).reshape(-1, 5))


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


def ground_height_m(x_m: float, y_m: float, terrain: Terrain) -> float:
    """Height of the ground above the datum at one point, metres (equation (2))."""
    height = terrain.base_m
    for i in range(len(terrain.peaks)):
        peak = terrain.peaks[i]
        u = (x_m - peak[1]) / peak[3]
        v = (y_m - peak[2]) / peak[4]
        exponent = u * u + v * v
        if exponent < 25.0:  # beyond, a peak of 1 km adds less than 2e-8 m
            height += peak[0] * math.exp(-exponent)
    if terrain.wave[0] != 0.0:
        height = max(height, datum_wave_m(x_m, y_m, terrain.wave))
    return height


def ground_heights_m(x_m: FloatArray, y_m: FloatArray, terrain: Terrain) -> FloatArray:
    """Heights of the ground at arrays of points of any one shape, metres (equation (2)); vectorised with numpy."""
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
