"""KML 2.2: a plan for Google Earth and other globes. Its absolute altitudes are AMSL, as a plan's."""

import xml.etree.ElementTree as ET
from collections.abc import Iterable, Sequence
from datetime import datetime, timedelta
from pathlib import Path

from missions.formats.files import write_text
from missions.formats.scene import (
    ALTITUDE_NOTE,
    AREA_COLOUR,
    EPOCH,
    OBSTACLE_COLOUR,
    RADAR_COLOUR,
    LatLon,
    Round,
    Scene,
    Stop,
    Track,
)

KML = "http://www.opengis.net/kml/2.2"
GX = "http://www.google.com/kml/ext/2.2"
_OPAQUE, _GLASS = 0xFF, 0x60
_TRACK_STEP_S = 5.0


def write_kml(scene: Scene, path: Path) -> None:
    """Write a scene: a folder a vehicle, with its way, its flight over time and its items. Raises InputError."""
    root = ET.Element("kml", {"xmlns": KML, "xmlns:gx": GX})
    document = _child(root, "Document")
    _child(document, "name", scene.name)
    _child(document, "description", f"{scene.description}\n{ALTITUDE_NOTE}".strip())
    for track in scene.tracks:
        _style(document, f"vehicle{track.sysid}", track.colour)
    for name, colour in (("radar", RADAR_COLOUR), ("obstacle", OBSTACLE_COLOUR), ("area", AREA_COLOUR)):
        _style(document, name, colour)
    for track in scene.tracks:
        _vehicle(document, track)
    surroundings = _child(document, "Folder")
    _child(surroundings, "name", "Surroundings")
    for radar in scene.radars:
        words = f"Sphere of {radar.radius_m:g} m around {radar.middle_m:g} m AMSL, drawn as its widest circle"
        _disc(surroundings, radar, "radar", words, radar.middle_m, extrude=False)
    for obstacle in scene.obstacles:
        words = f"Cylinder of {obstacle.radius_m:g} m, top at {obstacle.top_m:g} m AMSL"
        _disc(surroundings, obstacle, "obstacle", words, obstacle.top_m, extrude=True)
    _outline(surroundings, scene.area)
    ET.indent(root)
    write_text(path, '<?xml version="1.0" encoding="UTF-8"?>\n' + ET.tostring(root, encoding="unicode") + "\n")


def _vehicle(parent: ET.Element, track: Track) -> None:
    folder = _child(parent, "Folder")
    _child(folder, "name", f"{track.sysid} {track.name}")
    style = f"vehicle{track.sysid}"
    way = _placemark(folder, "Way", "", style)
    line = _child(way, "LineString")
    _child(line, "extrude", "1")
    _child(line, "altitudeMode", "absolute")
    _child(line, "coordinates", _coordinates(zip(track.lat_deg, track.lon_deg, track.alt_m, strict=True)))
    flight = _placemark(folder, "Flight over time", f"Launch at {EPOCH}; the date is arbitrary", style)
    moving = _child(flight, "gx:Track")
    _child(moving, "altitudeMode", "absolute")
    launch = datetime.fromisoformat(EPOCH)
    kept = _every(track, _TRACK_STEP_S)
    for i in kept:
        when = launch + timedelta(seconds=float(track.time_s[i]))
        _child(moving, "when", when.isoformat(timespec="milliseconds").replace("+00:00", "Z"))
    for i in kept:
        _child(moving, "gx:coord", f"{track.lon_deg[i]:.7f} {track.lat_deg[i]:.7f} {track.alt_m[i]:.2f}")
    for stop in track.stops:
        mark = _placemark(folder, f"{stop.seq} {stop.name}", _stop_words(stop), style, hidden=True)
        point = _child(mark, "Point")
        _child(point, "altitudeMode", "absolute")
        _child(point, "coordinates", _coordinates([(stop.lat_deg, stop.lon_deg, stop.alt_m)]))


def _every(track: Track, step_s: float) -> list[int]:
    """Indices of samples a step apart, the last one included."""
    kept: list[int] = []
    for i, time_s in enumerate(track.time_s.tolist()):
        if not kept or time_s >= track.time_s[kept[-1]] + step_s or i == len(track.time_s) - 1:
            kept.append(i)
    return kept


def _stop_words(stop: Stop) -> str:
    words = [f"{stop.alt_m:.1f} m AMSL"]
    if stop.time_s is not None:
        words.append(f"{stop.time_s:.1f} s after launch")
    if stop.airspeed_m_s is not None:
        words.append(f"airspeed {stop.airspeed_m_s:.2f} m/s")
    if stop.acceptance_m is not None:
        words.append(f"acceptance radius {stop.acceptance_m:g} m")
    return ", ".join(words)


def _disc(parent: ET.Element, place: Round, style: str, words: str, alt_m: float, *, extrude: bool) -> None:
    polygon = _child(_placemark(parent, place.name, words, style), "Polygon")
    if extrude:
        _child(polygon, "extrude", "1")
    _child(polygon, "altitudeMode", "absolute")
    ring = _child(_child(polygon, "outerBoundaryIs"), "LinearRing")
    _child(ring, "coordinates", _coordinates(_closed(place.rim, alt_m)))


def _outline(parent: ET.Element, area: Sequence[LatLon]) -> None:
    line = _child(_placemark(parent, "Area", "", "area"), "LineString")
    _child(line, "tessellate", "1")
    _child(line, "coordinates", _coordinates(_closed(area, 0.0)))


def _closed(ring: Sequence[LatLon], alt_m: float) -> list[tuple[float, float, float]]:
    return [(lat_deg, lon_deg, alt_m) for lat_deg, lon_deg in (*ring, ring[0])]


def _coordinates(places: Iterable[tuple[float, float, float]]) -> str:
    return " ".join(f"{lon_deg:.7f},{lat_deg:.7f},{alt_m:.2f}" for lat_deg, lon_deg, alt_m in places)


def _style(document: ET.Element, name: str, colour: str) -> None:
    style = _child(document, "Style", id=name)
    line = _child(style, "LineStyle")
    _child(line, "color", _abgr(colour, _OPAQUE))
    _child(line, "width", "3")
    _child(_child(style, "PolyStyle"), "color", _abgr(colour, _GLASS))
    _child(_child(style, "IconStyle"), "color", _abgr(colour, _OPAQUE))


def _abgr(colour: str, opacity: int) -> str:
    """ "#rrggbb" as KML's aabbggrr."""
    return f"{opacity:02x}{colour[5:7]}{colour[3:5]}{colour[1:3]}".lower()


def _placemark(parent: ET.Element, name: str, words: str, style: str, *, hidden: bool = False) -> ET.Element:
    mark = _child(parent, "Placemark")
    _child(mark, "name", name)
    if hidden:
        _child(mark, "visibility", "0")
    if words:
        _child(mark, "description", words)
    _child(mark, "styleUrl", f"#{style}")
    return mark


def _child(parent: ET.Element, tag: str, text: str | None = None, **attributes: str) -> ET.Element:
    child = ET.SubElement(parent, tag, attributes)
    child.text = text
    return child
