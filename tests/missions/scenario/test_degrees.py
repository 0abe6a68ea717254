"""Places by latitude and longitude are the same places as in metres, and a wrong one is named."""

import tomllib
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from missions.errors import InputError
from missions.frame import LocalFrame
from missions.scenario import Scenario, parse_scenario, read_scenario_text
from missions.scenario.degrees import in_metres
from missions.scenario.model import Files

RADARS, _ = read_scenario_text("radars")
TARGET = "target = [25000.0, 23500.0, 2500.0]"
FRAME = LocalFrame(46.5, 11.3, 250.0)
SPAN_M = st.floats(-30_000.0, 30_000.0)


def by_degrees(data: Any, frame: LocalFrame) -> Any:
    """A scenario's tables with all places on the globe."""
    if isinstance(data, list) and len(data) == 3 and all(isinstance(value, float) for value in data):
        lat_deg, lon_deg = frame.to_geodetic(data[0], data[1])
        return {"lat_deg": lat_deg, "lon_deg": lon_deg, "alt_m": data[2] + frame.alt_m}
    if isinstance(data, list):
        return [by_degrees(one, frame) for one in data]
    if isinstance(data, dict) and "x_m" in data and not isinstance(data["x_m"], list):
        lat_deg, lon_deg = frame.to_geodetic(data["x_m"], data["y_m"])
        rest = {key: value for key, value in data.items() if key not in ("x_m", "y_m")}
        return {**rest, "lat_deg": lat_deg, "lon_deg": lon_deg}
    return {key: by_degrees(value, frame) for key, value in data.items()} if isinstance(data, dict) else data


@pytest.mark.parametrize("name", ["radars", "ridge", "vee"])
def test_scenarios_that_ship_are_the_same_by_degrees(name: str) -> None:
    data = tomllib.loads(read_scenario_text(name)[0])
    files = Files(folder=Path(), raster=None)
    metres = Scenario.model_validate(data, context=files)
    degrees = Scenario.model_validate(by_degrees(data, metres.frame), context=files)
    for one, other in zip(metres.vehicles, degrees.vehicles, strict=True):
        assert metres.origin_m(one) == pytest.approx(degrees.origin_m(other), abs=1e-3)
        assert metres.target_m(one) == pytest.approx(degrees.target_m(other), abs=1e-3)
    for one, other in zip(metres.radars + metres.obstacles, degrees.radars + degrees.obstacles, strict=True):
        assert (one.x_m, one.y_m, one.radius_m) == pytest.approx((other.x_m, other.y_m, other.radius_m), abs=1e-3)


@given(x=SPAN_M, y=SPAN_M, z=st.floats(-100.0, 5000.0))
def test_a_point_by_degrees_is_within_a_millimetre(x: float, y: float, z: float) -> None:
    lat_deg, lon_deg = FRAME.to_geodetic(x, y)
    origin = {"lat_deg": FRAME.lat_deg, "lon_deg": FRAME.lon_deg, "alt_m": FRAME.alt_m}
    target = {"lat_deg": lat_deg, "lon_deg": lon_deg, "alt_m": z + FRAME.alt_m}
    (vehicle,) = in_metres({"origin": origin, "vehicles": [{"target": target}]})["vehicles"]
    assert vehicle["target"] == pytest.approx((x, y, z), abs=1e-3)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        (
            TARGET,
            "target = { lat_deg = 46.7, lon_deg = 11.6 }",
            r"vehicles\[3\]\.target\.alt_m: is missing; a place",
        ),
        (TARGET, "target = { lat = 46.7, lon_deg = 11.6, alt_m = 9.0 }", r"vehicles\[3\]\.target\.lat_deg: is missing"),
        (
            TARGET,
            "target = { lat_deg = 46.7, lon_deg = 11.6, alt_m = 9.0, z_m = 3.0 }",
            r"vehicles\[3\]\.target\.z_m: unknown key; a place by degrees has lat_deg, lon_deg, alt_m",
        ),
        (TARGET, 'target = { lat_deg = "N46", lon_deg = 11.6, alt_m = 9.0 }', r"target\.lat_deg: .*got 'N46'"),
        (TARGET, "target = { lat_deg = -46.7, lon_deg = 11.6, alt_m = 2500.0 }", r"vehicles\[3\]\.target.*outside the"),
        ("radius_m = 1500.0", "radius_m = 1500.0\nlat_deg = 46.6", r"radars\[0\]: stands at x_m and y_m or at lat"),
        ("lat_deg = ", "lat_deg = 1", r"origin\.lat_deg: must be <= 85"),
    ],
)
def test_a_wrong_place_is_named(old: str, new: str, message: str) -> None:
    assert old in RADARS
    with pytest.raises(InputError, match=message):
        parse_scenario(RADARS.replace(old, new, 1), "radars.toml")
