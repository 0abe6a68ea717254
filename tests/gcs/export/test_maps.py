"""Files for maps and globes: all vehicles in one, and each in its own."""

import json
import xml.etree.ElementTree as ET
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from gcs.export import ExportOptions, export
from gcs.scene import scene
from missions.altitude_frame import AltitudeFrame
from missions.errors import InputError
from missions.formats.kml import KML
from missions.scenario import Scenario
from planner.formation_plan import FormationPlan


def _names_in_kml(path: Path) -> set[str]:
    return {name.text or "" for name in ET.parse(path).iter(f"{{{KML}}}name")}


def _names_in_czml(path: Path) -> set[str]:
    return {packet["name"] for packet in json.loads(path.read_text())}


def _names_in_geojson(path: Path) -> set[str]:
    properties = [feature["properties"] for feature in json.loads(path.read_text())["features"]]
    return {
        f"{values['sysid']} {values['name']}" if values["kind"] == "way" else values["name"] for values in properties
    }


READERS: dict[str, Callable[[Path], set[str]]] = {
    "kml": _names_in_kml,
    "czml": _names_in_czml,
    "geojson": _names_in_geojson,
}


@pytest.mark.parametrize("file_format", READERS)
def test_one_file_holds_all_vehicles_and_each_other_its_own(
    scenario: Scenario, formation: FormationPlan, file_format: str, tmp_path: Path
) -> None:
    together, *single = export(scenario, formation, ExportOptions(file_format), tmp_path).files
    assert together == tmp_path / f"{scenario.name}.{file_format}"
    vehicles = {f"{uav.sysid} {uav.name}" for uav in formation.uavs}
    surroundings = {f"radar {i + 1}" for i in range(len(scenario.radars))}
    surroundings |= {f"obstacle {i + 1}" for i in range(len(scenario.obstacles))}
    assert READERS[file_format](together) >= vehicles | surroundings
    for uav, path in zip(formation.uavs, single, strict=True):
        names = READERS[file_format](path)
        assert names & vehicles == {f"{uav.sysid} {uav.name}"}
        assert names >= surroundings


def test_tracks_are_the_references_in_degrees_and_amsl(scenario: Scenario, formation: FormationPlan) -> None:
    references = formation.references(scenario)
    for track in scene(scenario, formation, formation.missions).tracks:
        reference = references[track.sysid]
        assert track.time_s[-1] == reference.duration_s
        planned = reference.positions(track.time_s)
        x, y = np.array([scenario.frame.to_local(*place) for place in zip(track.lat_deg, track.lon_deg, strict=True)]).T
        np.testing.assert_allclose(np.column_stack([x, y]), planned[:, :2], atol=0.01)
        np.testing.assert_allclose(track.alt_m - scenario.origin.alt_m, planned[:, 2], atol=0.01)


def test_stops_are_passed_when_the_track_is_there(scenario: Scenario, formation: FormationPlan) -> None:
    for track in scene(scenario, formation, formation.missions).tracks:
        timed = [stop for stop in track.stops if stop.time_s is not None]
        assert len(timed) == 4
        for stop in timed:
            assert stop.time_s is not None
            at = int(np.argmin(np.abs(track.time_s - stop.time_s)))
            x, y = scenario.frame.to_local(track.lat_deg[at], track.lon_deg[at])
            assert np.hypot(*np.subtract(scenario.frame.to_local(stop.lat_deg, stop.lon_deg), (x, y))) < 100.0


def test_a_map_takes_no_other_altitudes(scenario: Scenario, formation: FormationPlan, tmp_path: Path) -> None:
    with pytest.raises(InputError, match="--frame relative: a kml holds altitudes AMSL; leave it out"):
        export(scenario, formation, ExportOptions("kml", altitude=AltitudeFrame.relative), tmp_path)
