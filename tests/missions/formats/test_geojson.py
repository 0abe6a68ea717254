"""What is true of GeoJSON files (RFC 7946)."""

import itertools
import json
from pathlib import Path
from typing import Any

import pytest

from missions.formats.geojson import write_geojson
from missions.formats.scene import Scene


@pytest.fixture
def collection(scene: Scene, tmp_path: Path) -> dict[str, Any]:
    path = tmp_path / "any.geojson"
    write_geojson(scene, path)
    return dict(json.loads(path.read_text()))


def of_kind(collection: dict[str, Any], kind: str) -> list[dict[str, Any]]:
    return [feature for feature in collection["features"] if feature["properties"]["kind"] == kind]


def test_it_is_a_collection_of_features_that_says_what_its_heights_are(collection: dict[str, Any]) -> None:
    assert collection["type"] == "FeatureCollection"
    assert "crs" not in collection  # RFC 7946, section 4
    assert "above mean sea level" in collection["description"]
    for feature in collection["features"]:
        assert feature.keys() == {"type", "geometry", "properties"}
        assert feature["type"] == "Feature"


def test_ways_have_a_time_and_a_speed_for_each_place(collection: dict[str, Any], scene: Scene) -> None:
    for way, track in zip(of_kind(collection, "way"), scene.tracks, strict=True):
        wanted = zip(track.lon_deg, track.lat_deg, track.alt_m, strict=True)
        assert way["geometry"]["type"] == "LineString"
        assert way["geometry"]["coordinates"] == [pytest.approx(place, abs=1e-8) for place in wanted]
        properties = way["properties"]
        assert (properties["sysid"], properties["name"]) == (track.sysid, track.name)
        assert properties["times_s"] == track.time_s.tolist()
        assert properties["ground_speeds_m_s"] == track.speed_m_s.tolist()


def test_items_are_points_with_altitude_speed_and_time(collection: dict[str, Any]) -> None:
    waypoint = of_kind(collection, "item")[1]
    assert waypoint["geometry"] == {"type": "Point", "coordinates": [11.32, 46.5, 1400.0]}
    assert waypoint["properties"] == {
        "kind": "item",
        "sysid": 1,
        "name": "leader 3 waypoint",
        "item": 3,
        "altitude_amsl_m": 1400.0,
        "airspeed_m_s": 25.5,
        "time_s": 20.0,
        "acceptance_m": 80.0,
    }


@pytest.mark.parametrize("kind", ["radar", "obstacle", "area"])
def test_rings_are_closed_and_anticlockwise(collection: dict[str, Any], kind: str) -> None:
    (feature,) = of_kind(collection, kind)
    (ring,) = feature["geometry"]["coordinates"]
    assert ring[0] == ring[-1]
    area = sum(x0 * y1 - x1 * y0 for (x0, y0), (x1, y1) in itertools.pairwise(ring))
    assert area > 0.0


def test_a_radar_keeps_what_a_ring_cannot_say(collection: dict[str, Any]) -> None:
    (radar,) = of_kind(collection, "radar")
    assert radar["properties"] == {
        "kind": "radar",
        "name": "radar 1",
        "center": [11.35, 46.45],
        "radius_m": 750.0,
        "bottom_amsl_m": 1000.0,
        "top_amsl_m": 2500.0,
    }
