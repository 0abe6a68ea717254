"""Hidden routes of generated problems, and places around them."""

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.float64]

END_M = 2500.0
"""Between the ends of a route and the ends of its area."""
STEP_M = 25.0
ROOM_M = 60.0
"""Between a route and what must be kept from a wall."""


def stations_m(length_m: float, waypoints: int) -> FloatArray:
    """(waypoints + 2,) x of a route's corners, evenly along an area of a length."""
    return np.round(np.linspace(END_M, length_m - END_M, waypoints + 2))


def winding_m(
    rng: np.random.Generator, size_m: tuple[float, float, float], waypoints: int, bends: int, sideways: float
) -> FloatArray:
    """(waypoints + 2, 2) corners of a route that winds about the middle of its area.

    Args:
        size_m: of the area.
        bends: half waves of the shortest one.
        sideways: largest offset, in widths of the area.
    """
    x = stations_m(size_m[0], waypoints)
    part = np.linspace(0.0, 1.0, waypoints + 2)
    wave = np.arange(1, bends + 1)
    offsets = (rng.choice([-1.0, 1.0], bends) * rng.uniform(0.4, 1.0, bends) / wave**0.5) @ np.sin(
        np.pi * wave[:, None] * part
    )
    offsets *= sideways * size_m[1] / np.abs(offsets).max()
    return np.column_stack([x, np.round(0.5 * size_m[1] + offsets)])


def along_m(route_m: FloatArray) -> FloatArray:
    """(n, 2) points of a route at most `STEP_M` apart."""
    lengths = np.hypot(*np.diff(route_m, axis=0).T)
    legs = [
        np.linspace(p, q, int(length / STEP_M) + 2) for p, q, length in zip(route_m, route_m[1:], lengths, strict=False)
    ]
    return np.vstack(legs)


def clear_of_route(cylinders: FloatArray, route_m: FloatArray, keep_m: float) -> FloatArray:
    """Those rows x, y, radius, ... whose walls leave a route `keep_m` and some room."""
    points = along_m(route_m)
    distances = np.hypot(points[:, 0] - cylinders[:, 0, None], points[:, 1] - cylinders[:, 1, None]).min(
        axis=1, initial=np.inf
    )
    clear: FloatArray = cylinders[distances > cylinders[:, 2] + keep_m + ROOM_M]
    return clear
