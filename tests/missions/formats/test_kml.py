"""What is true of KML files."""

import xml.etree.ElementTree as ET
from datetime import datetime
from pathlib import Path

import pytest

from missions.errors import InputError
from missions.formats.kml import GX, KML, write_kml
from missions.formats.scene import EPOCH, Scene

NAMES = {"kml": KML, "gx": GX}


@pytest.fixture
def document(scene: Scene, tmp_path: Path) -> ET.Element:
    path = tmp_path / "any.kml"
    write_kml(scene, path)
    document = ET.fromstring(path.read_bytes()).find("kml:Document", NAMES)
    assert document is not None
    return document


def named(parent: ET.Element, name: str) -> ET.Element:
    (found,) = (element for element in parent.iter() if element.findtext("kml:name", None, NAMES) == name)
    return found


def coordinates(element: ET.Element) -> list[tuple[float, ...]]:
    texts = [found.text or "" for found in element.iter(f"{{{KML}}}coordinates")]
    return [tuple(map(float, place.split(","))) for text in texts for place in text.split()]


def test_each_vehicle_s_way_is_an_extruded_line_at_its_altitudes_amsl(document: ET.Element, scene: Scene) -> None:
    for track in scene.tracks:
        way = named(named(document, f"{track.sysid} {track.name}"), "Way")
        line = way.find("kml:LineString", NAMES)
        assert line is not None
        assert line.findtext("kml:extrude", None, NAMES) == "1"
        assert line.findtext("kml:altitudeMode", None, NAMES) == "absolute"
        wanted = list(zip(track.lon_deg, track.lat_deg, track.alt_m, strict=True))
        assert coordinates(way) == [pytest.approx(place, abs=1e-7) for place in wanted]


def test_a_flight_over_time_has_a_place_for_each_moment_from_launch_to_arrival(
    document: ET.Element, scene: Scene
) -> None:
    moving = named(named(document, "7 F6"), "Flight over time").find("gx:Track", NAMES)
    assert moving is not None
    moments = [datetime.fromisoformat(when.text or "") for when in moving.findall("kml:when", NAMES)]
    seconds = [(moment - datetime.fromisoformat(EPOCH)).total_seconds() for moment in moments]
    assert seconds == [0.0, 6.0, 12.0, 18.0, 20.0]
    places = [tuple(map(float, (place.text or "").split())) for place in moving.findall("gx:coord", NAMES)]
    assert places == [pytest.approx((11.3 + 0.001 * s, 46.51, 1200.0 + 10.0 * s), abs=1e-7) for s in seconds]


def test_items_say_when_how_fast_and_how_near(document: ET.Element) -> None:
    mark = named(named(document, "1 leader"), "3 waypoint")
    assert coordinates(mark) == [(11.32, 46.5, 1400.0)]
    words = "1400.0 m AMSL, 20.0 s after launch, airspeed 25.50 m/s, acceptance radius 80 m"
    assert mark.findtext("kml:description", None, NAMES) == words


def test_an_obstacle_stands_on_the_ground_up_to_its_top_and_a_radar_is_a_disc_at_its_middle(
    document: ET.Element, scene: Scene
) -> None:
    obstacle, radar = named(document, "obstacle 1"), named(document, "radar 1")
    assert obstacle.findtext("kml:Polygon/kml:extrude", None, NAMES) == "1"
    assert radar.find("kml:Polygon/kml:extrude", NAMES) is None
    for mark, place, alt_m in ((obstacle, scene.obstacles[0], 1650.0), (radar, scene.radars[0], 1750.0)):
        ring = coordinates(mark)
        assert ring[0] == ring[-1]
        assert ring[:-1] == [pytest.approx((lon, lat, alt_m), abs=1e-7) for lat, lon in place.rim]


def test_every_style_that_is_used_is_there_in_the_vehicle_s_colour(document: ET.Element) -> None:
    used = {url.text for url in document.iter(f"{{{KML}}}styleUrl")}
    styles = {f"#{style.get('id')}": style for style in document.findall("kml:Style", NAMES)}
    assert used <= styles.keys()
    assert styles["#vehicle1"].findtext("kml:LineStyle/kml:color", None, NAMES) == "ffb8454a"  # aabbggrr of #4a45b8


def test_a_description_with_markup_in_it_comes_through(document: ET.Element) -> None:
    description = document.findtext("kml:description", "", NAMES)
    assert description.startswith("Two <tracks> & more\n")
    assert "above mean sea level" in description


def test_a_folder_that_cannot_be_written_to_is_an_input_error(scene: Scene, tmp_path: Path) -> None:
    with pytest.raises(InputError, match="choose a folder"):
        write_kml(scene, tmp_path / "missing" / "any.kml")
