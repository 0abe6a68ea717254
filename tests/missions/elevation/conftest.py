"""A stretch of known ground, and a scenario over it."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import numpy.typing as npt
import pytest

from missions.elevation.resample import geodetic
from missions.environment import ground_heights_m
from missions.scenario import Scenario, load_scenario, read_scenario_text

FloatArray = npt.NDArray[np.float64]

WEST, EAST, SOUTH, NORTH = 10.9, 11.1, 46.9, 47.1
"""Degrees; the scenario's origin is in the middle, and its area reaches 5 km to all sides."""


def hills_m(lat_deg: FloatArray, lon_deg: FloatArray) -> FloatArray:
    """Height AMSL of the known ground: smooth, and different in all directions."""
    heights: FloatArray = 600.0 + 2000.0 * (lon_deg - 11.0) - 1500.0 * (lat_deg - 47.0)
    return heights + 30.0 * np.sin(300.0 * (lon_deg - 11.0))


def centres(low: float, high: float, count: int) -> FloatArray:
    """Middles of the cells between two edges."""
    return low + (np.arange(count) + 0.5) * (high - low) / count


def scenario_text(terrain: str, lat_deg: float, lon_deg: float) -> str:
    """One vehicle over the known ground."""
    shipped, _ = read_scenario_text("radars")
    airframe = shipped[shipped.index("[airframe]") : shipped.index("[formation]")]
    return f"""
name = "real"
[origin]
lat_deg = {lat_deg}
lon_deg = {lon_deg}
alt_m = 100.0
[area]
x_m = [-5000.0, 5000.0]
y_m = [-5000.0, 5000.0]
z_m = [0.0, 2500.0]
[terrain]
{terrain}
[[vehicles]]
name = "one"
sysid = 1
origin = [-4000.0, 0.0, 0.0]
target = [4000.0, 1000.0, 1000.0]
[limits]
altitude_max_m = 2500.0
separation_m = 100.0
clearance_m = 80.0
{airframe}
"""


@pytest.fixture
def hills() -> Callable[[FloatArray, FloatArray], FloatArray]:
    return hills_m


@pytest.fixture
def archive() -> dict[str, object]:
    """What a good archive over degrees holds."""
    lat, lon = centres(SOUTH, NORTH, 250)[::-1], centres(WEST, EAST, 180)
    lon_deg, lat_deg = np.meshgrid(lon, lat)
    return {"elevation": hills_m(lat_deg, lon_deg), "xmin": WEST, "xmax": EAST, "ymin": SOUTH, "ymax": NORTH}


@pytest.fixture
def load(tmp_path: Path) -> Callable[..., Scenario]:
    """The scenario with a [terrain], from a file in `tmp_path`, here or elsewhere."""

    def read(terrain: str, lat_deg: float = 47.0, lon_deg: float = 11.0) -> Scenario:
        (tmp_path / "real.toml").write_text(scenario_text(terrain, lat_deg, lon_deg))
        return load_scenario(str(tmp_path / "real.toml"))

    return read


@pytest.fixture
def largest_error_m() -> Callable[[Scenario], float]:
    """How far a scenario's ground is from the known one, at worst, at random places in its area."""

    def compare(scenario: Scenario) -> float:
        x, y = np.random.default_rng(1).uniform(-5000.0, 5000.0, (2, 2000))
        lat_deg, lon_deg = geodetic(scenario.frame, x, y)
        ground = ground_heights_m(x, y, scenario.environment.terrain)
        return float(np.abs(ground + 100.0 - hills_m(lat_deg, lon_deg)).max())

    return compare
