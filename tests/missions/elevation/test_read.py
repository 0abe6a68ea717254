"""Which file a scenario's raster is, and that it stands alone."""

from collections.abc import Callable

import pytest

from missions.errors import InputError
from missions.scenario import Scenario, load_scenario

Load = Callable[[str], Scenario]


@pytest.mark.parametrize(
    ("terrain", "message"),
    [
        ('raster = "nowhere.tif"', r"terrain\.raster: nowhere\.tif: no such file in /.*; a path counts from"),
        ('raster = "matplotlib:nowhere.npz"', r"matplotlib:nowhere\.npz: no such file in matplotlib's sample data"),
        ('raster = "real.toml"', r"real\.toml: must be a \.npz, \.tif, \.tiff, \.hgt file"),
        ('raster = "matplotlib:jacksboro_fault_dem.npz"', r"misses the area by \d+ km"),
        ('raster = "a.tif"\nbase_m = 5.0', "terrain: raster takes the place of base_m, wave and peaks"),
        ("spacing_m = 50.0", r"terrain: spacing_m is between the posts of a raster"),
        ('raster = "a.tif"\nspacing_m = 0.1', r"terrain\.spacing_m: must be >= 1"),
    ],
)
def test_what_cannot_be_used_is_named(load: Load, terrain: str, message: str) -> None:
    with pytest.raises(InputError, match=rf"^real\.toml: .*{message}"):
        load(terrain)


def test_the_shipped_ridge_is_as_high_as_its_source_says() -> None:
    terrain = load_scenario("ridge").environment.terrain
    heights = terrain.posts + 200.0
    assert 236.0 <= heights.min() < 245.0
    assert 1060.0 < heights.max() <= 1076.0
    assert 70.0 < terrain.spacing_x_m < 95.0


def test_a_copy_of_a_scenario_keeps_its_ground() -> None:
    ridge = load_scenario("ridge")
    assert ridge.model_copy(update={"vehicles": ridge.vehicles[:1]}).raster is ridge.raster
