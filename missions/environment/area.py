"""The box that a mission stays in (equation (1))."""

from typing import NamedTuple


class Area(NamedTuple):
    """Bounds of the flying range in the local frame, metres."""

    x_min_m: float
    x_max_m: float
    y_min_m: float
    y_max_m: float
    z_min_m: float
    z_max_m: float
