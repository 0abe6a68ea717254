"""A source of elevations as posts over a scenario's area, in its local frame."""

import math

import numpy as np
import numpy.typing as npt
from pyproj import Proj

from missions.elevation.source import ElevationSource
from missions.environment import Area
from missions.environment.raster import Raster, raster_heights_m
from missions.errors import InputError
from missions.frame import LocalFrame

FloatArray = npt.NDArray[np.float64]

POSTS_MAX = 20_000_000
ELSEWHERE = "lies in another part of the world than the scenario's area; check [origin]"
EDGE = 0.5 + 1e-6
"""Cells beyond the outermost posts that still count as covered: the outer half of their own cells."""


def resample(source: ElevationSource, frame: LocalFrame, area: Area, spacing_m: float | None) -> Raster:
    """Posts over the area's whole width and height, bilinear between the source's, above z = 0 of the frame.

    Args:
        spacing_m: between posts; about the source's own unless given. Made a little smaller to fit the area.

    Raises:
        InputError: the source does not cover the area, or has voids in it; the message begins with what is wrong.
    """
    own_spacing_m = _own_spacing_m(source, frame, area)
    spacing_m = spacing_m or own_spacing_m
    x, y = (_axis(low, high, spacing_m) for low, high in (area[0:2], area[2:4]))
    if x.size * y.size > POSTS_MAX:
        raise InputError(f"{x.size} by {y.size} posts over the area are too many; set terrain.spacing_m to more")
    lat_deg, lon_deg = geodetic(frame, *np.meshgrid(x, y))
    columns, rows = source.cells_of(lon_deg, lat_deg)
    if not (np.isfinite(columns).all() and np.isfinite(rows).all()):
        raise InputError(ELSEWHERE)
    _check_cover(columns, rows, source, own_spacing_m, (x[1] - x[0], y[1] - y[0]))
    first_row, last_row = _window(rows, source.shape[0])
    first_column, last_column = _window(columns, source.shape[1])
    heights = source.read(first_row, last_row, first_column, last_column)
    grid = Raster(heights, float(first_column), float(first_row), 1.0, 1.0)
    posts = raster_heights_m(columns, rows, grid) - frame.alt_m
    if void := int(np.count_nonzero(~np.isfinite(posts))):
        j, i = np.argwhere(~np.isfinite(posts))[0]
        raise InputError(
            f"has no height at {void} of the area's {posts.size} posts, the first at latitude {lat_deg[j, i]:.5f}, "
            f"longitude {lon_deg[j, i]:.5f}; fill its voids or make the area smaller"
        )
    return Raster(posts, float(x[0]), float(y[0]), float(x[1] - x[0]), float(y[1] - y[0]))


def check_local_cover(raster: Raster, area: Area) -> None:
    """Whether a raster that is already in the local frame covers the area and has no voids; raises InputError."""
    rows, columns = raster.posts.shape
    x1, y1 = raster.x0_m + (columns - 1) * raster.spacing_x_m, raster.y0_m + (rows - 1) * raster.spacing_y_m
    _refuse_beyond(
        west=raster.x0_m - area.x_min_m,
        east=area.x_max_m - x1,
        south=raster.y0_m - area.y_min_m,
        north=area.y_max_m - y1,
    )
    if void := int(np.count_nonzero(~np.isfinite(raster.posts))):
        raise InputError(f"posts_m has no height at {void} of {raster.posts.size} posts; fill its voids")


def geodetic(frame: LocalFrame, x_m: FloatArray, y_m: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Latitudes and longitudes in degrees of arrays of points in a local frame, as its `to_geodetic` has them."""
    projection = Proj(proj="aeqd", ellps="WGS84", lat_0=frame.lat_deg, lon_0=frame.lon_deg)
    lon_deg, lat_deg = projection(x_m, y_m, inverse=True)
    return lat_deg, lon_deg


def _own_spacing_m(source: ElevationSource, frame: LocalFrame, area: Area) -> float:
    """The smaller distance of neighbouring posts along columns and rows, in the middle of the area."""
    x, y, step = (area.x_min_m + area.x_max_m) / 2.0, (area.y_min_m + area.y_max_m) / 2.0, 10.0
    lat_deg, lon_deg = geodetic(frame, np.array([x, x + step, x]), np.array([y, y, y + step]))
    columns, rows = source.cells_of(lon_deg, lat_deg)
    cells = np.abs([np.diff(columns[:2])[0], columns[2] - columns[0], np.diff(rows[:2])[0], rows[2] - rows[0]])
    if not np.isfinite(cells).all():
        raise InputError(ELSEWHERE)
    return step / float(cells.max())


def _axis(low_m: float, high_m: float, spacing_m: float) -> FloatArray:
    return np.linspace(low_m, high_m, math.ceil((high_m - low_m) / spacing_m - 1e-9) + 1)


def _window(positions: FloatArray, count: int) -> tuple[int, int]:
    """The first and the last post, at least two of them, that positions are interpolated from."""
    first = min(max(int(np.floor(positions.min())), 0), count - 2)
    return first, min(max(int(np.ceil(positions.max())), first + 1), count - 1)


def _check_cover(
    columns: FloatArray, rows: FloatArray, source: ElevationSource, own_spacing_m: float, spacing_m: tuple[float, float]
) -> None:
    """Refuse a source that ends inside the area, and say on which sides and by how much.

    Args:
        columns, rows: where the area's posts lie in the source, (ny, nx).
        own_spacing_m: between the source's posts.
        spacing_m: between the area's, along x and y.
    """
    last_row, last_column = source.shape[0] - 1, source.shape[1] - 1
    off = np.hypot(
        np.maximum(np.maximum(-EDGE - columns, columns - last_column - EDGE), 0.0),
        np.maximum(np.maximum(-EDGE - rows, rows - last_row - EDGE), 0.0),
    )
    covered = off == 0.0
    if not covered.any():
        raise InputError(f"misses the area by {off.min() * own_spacing_m / 1000.0:.0f} km; check [origin] and [area]")
    columns_covered, rows_covered = np.flatnonzero(covered.any(axis=0)), np.flatnonzero(covered.any(axis=1))
    ny, nx = covered.shape
    _refuse_beyond(
        west=columns_covered[0] * spacing_m[0],
        east=(nx - 1 - columns_covered[-1]) * spacing_m[0],
        south=rows_covered[0] * spacing_m[1],
        north=(ny - 1 - rows_covered[-1]) * spacing_m[1],
    )
    if not covered.all():
        share = 1.0 - covered.mean()
        raise InputError(f"leaves {share:.1%} of the area in its corners uncovered; make the area smaller")


def _refuse_beyond(**missing_m: float) -> None:
    sides = [f"{distance:.0f} m in the {side}" for side, distance in missing_m.items() if distance > 1e-3]
    if sides:
        raise InputError(f"does not cover the area: {' and '.join(sides)} are missing; make the area smaller")
