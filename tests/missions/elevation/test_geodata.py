"""GeoTIFF and HGT files, as others write them."""

import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import rasterio
from rasterio.transform import from_bounds, from_origin

from missions.errors import InputError
from missions.scenario import Scenario

Load = Callable[..., Scenario]
Compare = Callable[[Scenario], float]


def write(path: Path, heights: np.ndarray, **options: Any) -> None:
    rows, columns = heights.shape
    profile = {"width": columns, "height": rows, "count": 1, "dtype": heights.dtype, **options}
    with rasterio.open(path, "w", **profile) as dataset:
        dataset.write(heights, 1)


def in_degrees(archive: dict[str, Any]) -> dict[str, Any]:
    rows, columns = archive["elevation"].shape
    edges = archive["xmin"], archive["ymin"], archive["xmax"], archive["ymax"]
    return {"crs": "EPSG:4326", "transform": from_bounds(*edges, columns, rows)}


def test_a_geotiff_in_degrees(tmp_path: Path, archive: dict[str, Any], load: Load, largest_error_m: Compare) -> None:
    write(tmp_path / "hills.tif", archive["elevation"].astype(np.float32), **in_degrees(archive))
    assert largest_error_m(load('raster = "hills.tif"')) < 1.0


def test_a_geotiff_in_metres_of_another_projection(
    tmp_path: Path, load: Load, largest_error_m: Compare, hills: Callable[..., np.ndarray]
) -> None:
    from pyproj import Transformer

    to_utm = Transformer.from_crs("EPSG:4326", "EPSG:32632", always_xy=True)
    middle_x, middle_y = to_utm.transform(11.0, 47.0)
    west, north = middle_x - 6000.0, middle_y + 6000.0
    x, y = np.meshgrid(west + 60.0 * (np.arange(200) + 0.5), north - 60.0 * (np.arange(200) + 0.5))
    lon, lat = to_utm.transform(x, y, direction="INVERSE")
    write(tmp_path / "utm.tif", hills(lat, lon), crs="EPSG:32632", transform=from_origin(west, north, 60.0, 60.0))
    scenario = load('raster = "utm.tif"')
    assert largest_error_m(scenario) < 1.0
    assert scenario.environment.terrain.spacing_x_m == pytest.approx(60.0, abs=1.0)


def test_an_hgt_tile_has_its_posts_on_its_edges(
    tmp_path: Path, load: Load, largest_error_m: Compare, hills: Callable[..., np.ndarray]
) -> None:
    degrees = np.arange(1201) / 1200.0
    lon, lat = np.meshgrid(11.0 + degrees, 48.0 - degrees)
    half = 0.5 / 1200.0
    place = {
        "crs": "EPSG:4326",
        "transform": from_bounds(11.0 - half, 47.0 - half, 12.0 + half, 48.0 + half, 1201, 1201),
    }
    write(tmp_path / "N47E011.hgt", np.round(hills(lat, lon)).astype(np.int16), driver="SRTMHGT", **place)
    text = 'raster = "N47E011.hgt"'
    scenario = load(text, lat_deg=47.5, lon_deg=11.5)
    assert largest_error_m(scenario) < 1.5  # heights are whole metres
    with pytest.raises(
        InputError, match=r"N47E011\.hgt: does not cover the area: 5000 m in the west and 5000 m in the south"
    ):
        load(text)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"crs": None}, "does not say in which coordinates it is"),
        ({"nodata": 0.0}, r"has no height at \d+ of the area's"),
    ],
)
def test_bad_geotiffs_are_named_with_the_reason(
    tmp_path: Path, archive: dict[str, Any], load: Load, change: dict[str, Any], message: str
) -> None:
    heights = archive["elevation"].copy()
    heights[120:125, 90] = 0.0
    write(tmp_path / "hills.tif", heights, **in_degrees(archive) | change)
    with pytest.raises(InputError, match=rf"^real\.toml: terrain\.raster: hills\.tif: {message}"):
        load('raster = "hills.tif"')


def test_heights_in_feet_are_refused(tmp_path: Path, archive: dict[str, Any], load: Load) -> None:
    write(tmp_path / "hills.tif", archive["elevation"], **in_degrees(archive))
    with rasterio.open(tmp_path / "hills.tif", "r+") as dataset:
        dataset.units = ("ft",)
    with pytest.raises(InputError, match=r"hills\.tif: heights are in ft, not in metres"):
        load('raster = "hills.tif"')


def test_what_gdal_cannot_read_says_so(tmp_path: Path, load: Load) -> None:
    (tmp_path / "hills.tif").write_bytes(b"II*\0 not really")
    with pytest.raises(InputError, match=r"hills\.tif: not an elevation file that GDAL can read"):
        load('raster = "hills.tif"')


def test_without_rasterio_the_extra_is_named(tmp_path: Path, load: Load, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "hills.tif").touch()
    monkeypatch.setitem(sys.modules, "rasterio", None)
    with pytest.raises(InputError, match=r"hills\.tif: needs rasterio: pip install 'skein-gcs\[terrain\]'"):
        load('raster = "hills.tif"')
