"""What is true of CZML files."""

import json
from pathlib import Path
from typing import Any

import pytest

from missions.formats.czml import write_czml
from missions.formats.scene import EPOCH, Scene


@pytest.fixture
def packets(scene: Scene, tmp_path: Path) -> list[dict[str, Any]]:
    path = tmp_path / "any.czml"
    write_czml(scene, path)
    return list(json.loads(path.read_text()))


def test_the_document_comes_first_with_a_clock_as_long_as_the_flight(packets: list[dict[str, Any]]) -> None:
    document = packets[0]
    assert (document["id"], document["version"]) == ("document", "1.0")
    assert document["clock"]["interval"] == f"{EPOCH}/2026-01-01T00:00:20.000Z"
    assert "above mean sea level" in document["description"]
    assert "ellipsoid" in document["description"]


def test_every_packet_has_an_id_of_its_own(packets: list[dict[str, Any]]) -> None:
    assert [packet["id"] for packet in packets] == [
        *("document", "vehicle/1", "vehicle/7", "radar/1", "obstacle/1", "area"),
    ]


def test_a_vehicle_s_place_is_sampled_over_time(packets: list[dict[str, Any]], scene: Scene) -> None:
    for packet, track in zip(packets[1:3], scene.tracks, strict=True):
        assert packet["position"]["epoch"] == EPOCH
        values = packet["position"]["cartographicDegrees"]
        rows = [tuple(values[i : i + 4]) for i in range(0, len(values), 4)]
        wanted = zip(track.time_s, track.lon_deg, track.lat_deg, track.alt_m, strict=True)
        assert rows == [pytest.approx(row, abs=1e-8) for row in wanted]
        assert packet["path"]["material"]["solidColor"]["color"]["rgba"] == [0x4A, 0x45, 0xB8, 255]


def test_a_radar_is_an_ellipsoid_and_an_obstacle_a_cylinder_around_their_middles(packets: list[dict[str, Any]]) -> None:
    radar, obstacle = packets[3:5]
    assert radar["position"]["cartographicDegrees"] == [11.35, 46.45, 1750.0]
    assert radar["ellipsoid"]["radii"]["cartesian"] == [750.0] * 3
    assert obstacle["position"]["cartographicDegrees"] == [11.45, 46.55, 1400.0]
    cylinder = obstacle["cylinder"]
    assert (cylinder["length"], cylinder["topRadius"], cylinder["bottomRadius"]) == (500.0, 750.0, 750.0)
