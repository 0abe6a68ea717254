"""The operators' guide is true, and its example is what it says."""

import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from matplotlib import get_data_path


@pytest.fixture
def folder(tmp_path: Path, root: Path) -> Path:
    """The example's folder, with two tiles of its ground."""
    rasterio = pytest.importorskip("rasterio")
    shutil.copy(root / "docs/gap.toml", tmp_path)
    with np.load(Path(get_data_path()) / "sample_data" / "jacksboro_fault_dem.npz") as sample:
        heights, west, east = sample["elevation"], float(sample["xmin"]), float(sample["xmax"])
        south, north = sorted((float(sample["ymin"]), float(sample["ymax"])))
    rows, columns = heights.shape
    width_deg = (east - west) / columns
    for name, first, last in (("west", 0, columns // 2), ("east", columns // 2, columns)):
        edges = (west + first * width_deg, south, west + last * width_deg, north)
        transform = rasterio.transform.from_bounds(*edges, last - first, rows)
        profile = {"driver": "GTiff", "dtype": "int16", "count": 1, "crs": "EPSG:4326", "transform": transform}
        with rasterio.open(tmp_path / f"{name}.tif", "w", height=rows, width=last - first, **profile) as tile:
            tile.write(heights[:, first:last], 1)
    return tmp_path


@pytest.mark.timeout(600)
def test_the_guide_s_commands_do_what_it_says(follow: Callable[[Path], None], folder: Path, root: Path) -> None:
    follow(root / "docs/operators.md")
    assert {path.name for path in (folder / "runs/gap/figures").iterdir()} == {
        *("scene.png", "plan_views.png", "heights.png")
    }


def test_the_example_plans_on_a_joined_tile_as_on_the_sample(folder: Path, root: Path) -> None:
    from missions.scenario import load_scenario

    rio = pytest.importorskip("rasterio.merge")
    rio.merge([folder / "west.tif", folder / "east.tif"], dst_path=folder / "ground.tif")
    text = (root / "docs/gap.toml").read_text(encoding="utf-8")
    (folder / "tile.toml").write_text(text.replace("matplotlib:jacksboro_fault_dem.npz", "ground.tif"))
    one, other = (load_scenario(str(path)) for path in (root / "docs/gap.toml", folder / "tile.toml"))
    assert one.raster is not None
    assert other.raster is not None
    # The two differ by how exactly degrees are written: no more than a step between neighbouring posts of a cliff.
    assert np.abs(one.raster.posts - other.raster.posts).max() < 1.0


def test_lines_of_the_example_are_its_own(blocks: Callable[[Path], list[Any]], root: Path) -> None:
    example = (root / "docs/gap.toml").read_text(encoding="utf-8")
    for block in blocks(root / "docs/operators.md"):
        if block.kind == "toml":
            for line in block.text.splitlines():
                assert line in example
