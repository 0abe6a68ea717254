"""Fractal ground for generated problems: octaves of smooth noise, by additions and products alone, which every machine
rounds alike."""

import numpy as np
import numpy.typing as npt

from missions.environment import Terrain
from missions.environment.terrain import NO_WAVE

FloatArray = npt.NDArray[np.float64]

SPACING_M = 200.0
"""Between two posts."""
COARSEST_M = 8000.0
PAD_M = 2500.0, 5000.0
"""Around an origin the ground is level up to the first distance, and untouched from the second on."""


def posts_m(size_m: tuple[float, float, float]) -> tuple[FloatArray, FloatArray]:
    """x (nx,) and y (ny,) of the posts of an area."""
    x, y = (SPACING_M * np.arange(round(size / SPACING_M) + 1, dtype=np.float64) for size in size_m[:2])
    return x, y


def fractal_m(rng: np.random.Generator, size_m: tuple[float, float, float], relief_m: float) -> FloatArray:
    """(ny, nx) heights from 0 to `relief_m`: each octave has half the size and half the height of the one before."""
    x, y = posts_m(size_m)
    heights = np.zeros((len(y), len(x)))
    scale, amplitude = COARSEST_M, 1.0
    while scale >= 2.0 * SPACING_M:
        heights += amplitude * _octave(rng, x / scale, y / scale)
        scale, amplitude = scale / 2.0, amplitude / 2.0
    low, high = heights.min(), heights.max()
    relief: FloatArray = relief_m * (heights - low) / (high - low)
    return relief


def level_pad_m(heights_m: FloatArray, size_m: tuple[float, float, float], centre_m: FloatArray) -> FloatArray:
    """The same ground, level at 0 around a place, where an aircraft is launched."""
    x, y = posts_m(size_m)
    distance = np.sqrt((x - centre_m[0]) ** 2 + (y[:, None] - centre_m[1]) ** 2)
    level: FloatArray = heights_m * smooth_step((distance - PAD_M[0]) / (PAD_M[1] - PAD_M[0]))
    return level


def smooth_step(x: FloatArray) -> FloatArray:
    """From 0 at 0 to 1 at 1, level at both."""
    x = np.clip(x, 0.0, 1.0)
    return x * x * (3.0 - 2.0 * x)


def raster_terrain(heights_m: FloatArray) -> Terrain:
    """Ground with its posts at these heights, to the decimetre."""
    return Terrain(0.0, NO_WAVE, (), np.round(heights_m, 1), spacing_x_m=SPACING_M, spacing_y_m=SPACING_M)


def flat_terrain() -> Terrain:
    """Level ground at 0."""
    return Terrain(0.0, NO_WAVE, ())


def _octave(rng: np.random.Generator, x: FloatArray, y: FloatArray) -> FloatArray:
    """Smooth noise on a lattice of unit cells."""
    i, j = x.astype(np.int64), y.astype(np.int64)
    lattice = rng.uniform(-1.0, 1.0, (int(j.max()) + 2, int(i.max()) + 2))
    u, v = smooth_step(x - i), smooth_step(y - j)[:, None]
    below = lattice[j[:, None], i] * (1.0 - u) + lattice[j[:, None], i + 1] * u
    above = lattice[j[:, None] + 1, i] * (1.0 - u) + lattice[j[:, None] + 1, i + 1] * u
    return below * (1.0 - v) + above * v
