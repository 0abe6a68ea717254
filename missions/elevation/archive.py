"""Elevation in numpy archives (.npz): posts over degrees, or over the metres of a scenario's local frame.

Over degrees, as in matplotlib's sample `jacksboro_fault_dem.npz`:

    elevation                    (rows, columns) metres AMSL; the first row is the north one, the first column the west
                                 one; nan, or masked, where there is none
    xmin, xmax, ymin, ymax       longitudes and latitudes of the outer edges of the outer cells, each cell with its post
                                 in the middle; ymin and ymax in either order

Over metres, as a run keeps it:

    posts_m                      (rows, columns) metres above z = 0; the first row is the south one
    x0_m, y0_m                   where posts_m[0, 0] stands, local frame
    spacing_x_m, spacing_y_m     between neighbouring posts
"""

import zipfile
from collections.abc import Mapping
from pathlib import Path

import numpy as np
import numpy.typing as npt

from missions.elevation.source import ElevationSource
from missions.environment.raster import Raster
from missions.errors import InputError

FloatArray = npt.NDArray[np.float64]

EDGES = ("xmin", "xmax", "ymin", "ymax")
PLACING = ("x0_m", "y0_m", "spacing_x_m", "spacing_y_m")


def read_archive(path: Path) -> ElevationSource | Raster:
    """A source over degrees, or a raster that is already in the local frame.

    Raises:
        InputError: not such an archive; the message begins with what is wrong, without the file's name.
    """
    try:
        with np.load(path, allow_pickle=False) as archive:
            values = {key: np.asarray(archive[key]) for key in archive.files}
    except (ValueError, EOFError, AttributeError, zipfile.BadZipFile):
        raise InputError("not a numpy archive; numpy.savez writes one") from None
    if "posts_m" in values:
        numbers = (_number(values, key) for key in PLACING)
        raster = Raster(_grid(values, "posts_m"), *numbers)
        if not (raster.spacing_x_m > 0.0 and raster.spacing_y_m > 0.0):
            raise InputError("spacing_x_m and spacing_y_m must be > 0")
        return raster
    if "elevation" not in values:
        known = ", ".join(sorted(values)) or "nothing"
        raise InputError(f"has neither elevation nor posts_m, but {known}; see missions/elevation/archive.py")
    heights = _grid(values, "elevation")
    west, east, *edges = (_number(values, key) for key in EDGES)
    south, north = min(edges), max(edges)
    if not (west < east and -90.0 <= south < north <= 90.0):
        raise InputError("xmin must be west of xmax, and ymin and ymax two latitudes")
    rows, columns = heights.shape

    def cells_of(lon_deg: FloatArray, lat_deg: FloatArray) -> tuple[FloatArray, FloatArray]:
        return (lon_deg - west) / (east - west) * columns - 0.5, (north - lat_deg) / (north - south) * rows - 0.5

    return ElevationSource(heights.shape, cells_of, lambda r0, r1, c0, c1: heights[r0 : r1 + 1, c0 : c1 + 1])


def write_local_raster(raster: Raster, path: Path) -> None:
    """Keep a raster over metres. Raises OSError."""
    placing = {key: getattr(raster, key) for key in PLACING}
    np.savez_compressed(path, posts_m=raster.posts, **placing)


def _number(values: Mapping[str, npt.NDArray[np.generic]], key: str) -> float:
    value = values.get(key)
    if value is None:
        raise InputError(f"has no {key}; see missions/elevation/archive.py")
    if value.size != 1 or value.dtype.kind not in "iuf" or not np.isfinite(value).all():
        raise InputError(f"{key} must be one finite number")
    return float(value.item())


def _grid(
    values: Mapping[str, npt.NDArray[np.generic]], key: str
) -> "np.ndarray[tuple[int, int], np.dtype[np.float64]]":
    grid = values[key]
    if grid.ndim != 2 or min(grid.shape) < 2 or grid.dtype.kind not in "iuf":
        raise InputError(f"{key} must be numbers in at least 2 rows and 2 columns, has shape {grid.shape}")
    return grid.astype(np.float64)
