"""Numpy archives, over degrees and over metres, and what is wrong with others."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from missions.elevation import write_local_raster
from missions.environment.raster import Raster
from missions.errors import InputError
from missions.scenario import Scenario

Load = Callable[[str], Scenario]
Compare = Callable[[Scenario], float]


def test_ground_over_degrees_lies_where_it_should(
    tmp_path: Path, archive: dict[str, object], load: Load, largest_error_m: Compare
) -> None:
    np.savez(tmp_path / "hills.npz", **archive)
    scenario = load('raster = "hills.npz"')
    assert largest_error_m(scenario) < 1.0
    terrain = scenario.environment.terrain
    assert 80.0 < terrain.spacing_x_m < 95.0  # 0.2 degrees in 250 rows are 89 m, in 180 columns 84 m
    coarse = load('raster = "hills.npz"\nspacing_m = 400').environment.terrain
    assert (coarse.spacing_x_m, coarse.posts.shape) == (400.0, (26, 26))


def test_the_first_row_is_north_however_the_edges_are_named(
    tmp_path: Path, archive: dict[str, object], load: Load, largest_error_m: Compare
) -> None:
    archive["ymin"], archive["ymax"] = archive["ymax"], archive["ymin"]
    np.savez(tmp_path / "hills.npz", **archive)
    assert largest_error_m(load('raster = "hills.npz"')) < 1.0


def test_a_raster_over_metres_comes_back_as_it_was(tmp_path: Path, load: Load) -> None:
    posts = np.random.default_rng(2).uniform(0.0, 500.0, (21, 26))
    raster = Raster(posts, -5000.0, -5000.0, 400.0, 500.0)
    write_local_raster(raster, tmp_path / "own.npz")
    again = load('raster = "own.npz"').raster
    assert again is not None
    assert np.array_equal(again.posts, posts)
    assert again[1:] == raster[1:]


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"elevation": None}, "has neither elevation nor posts_m, but xmax, xmin, ymax, ymin"),
        ({"xmin": None}, "has no xmin"),
        ({"xmin": "west"}, "xmin must be one finite number"),
        ({"xmin": np.nan}, "xmin must be one finite number"),
        ({"xmin": 12.0}, "xmin must be west of xmax"),
        ({"ymin": 147.0}, "two latitudes"),
        ({"elevation": np.zeros(5)}, r"elevation must be numbers in at least 2 rows and 2 columns, has shape \(5,\)"),
        ({"elevation": np.zeros((1, 5))}, "at least 2 rows"),
        ({"elevation": np.full((4, 4), "high")}, "elevation must be numbers"),
        (
            {"elevation": np.full((4, 4), np.nan)},
            r"has no height at \d+ of the area's \d+ posts, the first at latitude",
        ),
        ({"xmin": 10.97, "xmax": 11.07}, r"does not cover the area: 27\d\d m in the west are missing"),
        ({"ymax": 47.02}, r"does not cover the area: 28\d\d m in the north are missing"),
        ({"xmin": 20.9, "xmax": 21.1}, r"misses the area by 74\d km"),
        ({"posts_m": np.zeros((3, 3))}, "has no x0_m"),
        (
            {"posts_m": np.zeros((3, 3)), "x0_m": 0.0, "y0_m": 0.0, "spacing_x_m": 0.0, "spacing_y_m": 1.0},
            "must be > 0",
        ),
        (
            {"posts_m": np.zeros((3, 3)), "x0_m": -5000.0, "y0_m": -4000.0, "spacing_x_m": 4e3, "spacing_y_m": 5e3},
            "does not cover the area: 2000 m in the east and 1000 m in the south are missing",
        ),
        (
            {"posts_m": np.full((3, 3), np.nan), "x0_m": -5e3, "y0_m": -5e3, "spacing_x_m": 5e3, "spacing_y_m": 5e3},
            "posts_m has no height at 9 of 9 posts",
        ),
    ],
)
def test_bad_archives_are_named_with_the_reason(
    tmp_path: Path, archive: dict[str, object], load: Load, change: dict[str, object], message: str
) -> None:
    values = {key: value for key, value in (archive | change).items() if value is not None}
    np.savez(tmp_path / "hills.npz", **values)
    with pytest.raises(InputError, match=rf"^real\.toml: terrain\.raster: hills\.npz: .*{message}"):
        load('raster = "hills.npz"')


def test_what_is_no_archive_says_so(tmp_path: Path, load: Load) -> None:
    (tmp_path / "hills.npz").write_bytes(b"PK not really")
    with pytest.raises(InputError, match=r"hills\.npz: not a numpy archive"):
        load('raster = "hills.npz"')
