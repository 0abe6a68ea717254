"""Elevation in GeoTIFF and HGT files, by way of rasterio (extra `[terrain]`)."""

from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
from pyproj import Transformer

from missions.elevation.source import ElevationSource
from missions.errors import InputError

FloatArray = npt.NDArray[np.float64]

METRES = ("", "m", "metre", "metres", "meter", "meters")
WGS84 = "EPSG:4326"


def read_geodata(path: Path) -> ElevationSource:
    """A file that GDAL reads, band 1.

    Raises:
        InputError: it cannot be used; the message begins with what is wrong, without the file's name.
    """
    try:
        import rasterio
        from rasterio.errors import RasterioIOError
        from rasterio.windows import Window
    except ImportError:
        raise InputError("needs rasterio: pip install 'skein-gcs[terrain]'; or give a .npz") from None
    try:
        dataset: Any = rasterio.open(path)
    except RasterioIOError as error:
        raise InputError(f"not an elevation file that GDAL can read: {error}") from None
    with dataset:
        if dataset.crs is None:
            raise InputError("does not say in which coordinates it is; give it a coordinate reference system")
        unit = (dataset.units[0] or "").lower()
        if unit not in METRES:
            raise InputError(f"heights are in {unit}, not in metres; convert it")
        if min(dataset.shape) < 2:
            raise InputError(f"needs at least 2 rows and 2 columns, has {dataset.shape}")
        to_own = Transformer.from_crs(WGS84, dataset.crs.to_wkt(), always_xy=True)
        to_pixels, shape = ~dataset.transform, dataset.shape

    def cells_of(lon_deg: FloatArray, lat_deg: FloatArray) -> tuple[FloatArray, FloatArray]:
        x, y = to_own.transform(lon_deg, lat_deg)
        columns = to_pixels.a * x + to_pixels.b * y + to_pixels.c
        rows = to_pixels.d * x + to_pixels.e * y + to_pixels.f
        return columns - 0.5, rows - 0.5  # a pixel's height is that of its middle

    def read(first_row: int, last_row: int, first_column: int, last_column: int) -> FloatArray:
        window = Window(first_column, first_row, last_column - first_column + 1, last_row - first_row + 1)
        with rasterio.open(path) as opened:
            heights = opened.read(1, window=window, masked=True)
        filled: FloatArray = np.ma.filled(heights.astype(np.float64), np.nan)
        return filled

    return ElevationSource(shape, cells_of, read)
