"""How close vehicles come to each other at the same time."""

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.float64]


def least_separation_m(positions_m: FloatArray) -> FloatArray:
    """The least distance between any two vehicles at each tick, (n_tick,); NaN where fewer than two are known.

    Args:
        positions_m: (n_uav, n_tick, 3); NaN where a vehicle is not known.
    """
    # Coordinates come first, so that each pair is three passes over contiguous memory.
    x, y, z = np.ascontiguousarray(np.moveaxis(positions_m, -1, 0))
    least: FloatArray = np.full(positions_m.shape[1], np.nan)
    for i in range(len(positions_m)):
        for j in range(i):
            least = np.fmin(least, (x[i] - x[j]) ** 2 + (y[i] - y[j]) ** 2 + (z[i] - z[j]) ** 2)
    distances: FloatArray = np.sqrt(least)
    return distances
