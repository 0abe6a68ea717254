"""Radars: spheres in which a flight is exposed (equations (7)-(8)). A radar is a cost, not a wall."""

from typing import NamedTuple

import numpy as np
import numpy.typing as npt


class Radar(NamedTuple):
    """A radar's sphere in the local frame, metres.

    `intensity_m` is delta of equation (7); distances below `CORE` radii count as that, since the integral of
    (delta / D)^4 diverges at the centre.
    """

    x_m: float
    y_m: float
    z_m: float
    radius_m: float
    intensity_m: float


CORE = 0.1
"""Smallest distance that counts, in radii of the radar (MODEL, section 3)."""


def exposed(points_m: npt.NDArray[np.float64], radars: tuple[Radar, ...]) -> npt.NDArray[np.bool_]:
    """Which points (..., 3) lie within the radius of any radar; shape (...)."""
    inside = np.zeros(points_m.shape[:-1], dtype=np.bool_)
    for radar in radars:
        centre = np.array([radar.x_m, radar.y_m, radar.z_m])
        inside |= np.linalg.norm(points_m - centre, axis=-1) <= radar.radius_m
    return inside
