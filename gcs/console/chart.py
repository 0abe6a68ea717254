"""From metres in the local frame to the units that a scene is drawn in."""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from gcs.figures.paths import Ground
from gcs.figures.scene import EXAGGERATIONS

FloatArray = npt.NDArray[np.float64]

SIDE = 10.0
"""The longer side of what is shown, in units of the scene: what a browser's camera is made for."""
HEIGHT_SHARE = 0.2
"""How high it is drawn, at the most, as a share of that side: hills are to look like hills."""
SMALLEST_M = 1000.0
"""Vehicles that stand together are not shown any larger."""


@dataclass(frozen=True)
class Chart:
    """What part of the world is shown, and how large.

    Attributes:
        low_m, high_m: (x, y, z) of its corners.
        heights: factor by which they are exaggerated.
    """

    low_m: tuple[float, float, float]
    high_m: tuple[float, float, float]
    heights: int

    @property
    def units_per_m(self) -> float:
        """Of the scene, on the level."""
        longer_m = max(self.high_m[0] - self.low_m[0], self.high_m[1] - self.low_m[1], SMALLEST_M)
        return SIDE / longer_m

    def units(self, points_m: npt.ArrayLike) -> FloatArray:
        """Points (..., 3) in metres to units of the scene, whose origin is on the lowest ground in the middle."""
        (x0, y0, z0), (x1, y1, _) = self.low_m, self.high_m
        scale = self.units_per_m * np.array([1.0, 1.0, self.heights])
        found: FloatArray = (np.asarray(points_m) - (0.5 * (x0 + x1), 0.5 * (y0 + y1), z0)) * scale
        return found


def chart_of(ground: Ground, top_m: float) -> Chart:
    """The chart of some ground and what is above it, up to `top_m`."""
    x0, x1, y0, y1 = ground.extent_m
    low_m = float(ground.z_m.min())
    height_m = max(top_m - low_m, 1.0)
    longer_m = max(x1 - x0, y1 - y0)
    heights = max(one for one in EXAGGERATIONS if one == 1 or one * height_m <= HEIGHT_SHARE * longer_m)
    return Chart((x0, y0, low_m), (x1, y1, max(top_m, float(ground.z_m.max()))), heights)


def chart_around(points_m: npt.ArrayLike) -> Chart:
    """The chart of some points (n, 3), with as much around them."""
    points = np.atleast_2d(np.asarray(points_m, dtype=np.float64))
    low, high = points.min(axis=0), points.max(axis=0)
    margin = max(SMALLEST_M, float((high - low)[:2].max()))
    (x0, y0), (x1, y1) = (low[:2] - margin).tolist(), (high[:2] + margin).tolist()
    return Chart((x0, y0, float(low[2])), (x1, y1, float(high[2])), heights=1)
