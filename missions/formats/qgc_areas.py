"""The fence and the rally points of a `.plan` file."""

from collections.abc import Iterator, Sequence
from typing import Any

from missions.fence import LEAST_VERTICES, Fence, FenceCircle, FencePolygon, LatLonE7, rally_items
from missions.formats.json_reader import JsonReader
from missions.mission import MissionItem

_VERSION = 2
_AREA_VERSION = 1


def fence_section(fence: Fence) -> dict[str, Any]:
    """The section `geoFence`."""
    section: dict[str, Any] = {
        "version": _VERSION,
        "circles": [
            {
                "version": _AREA_VERSION,
                "inclusion": area.inclusion,
                "circle": {"center": _degrees(area.center), "radius": area.radius_m},
            }
            for area in fence.areas
            if isinstance(area, FenceCircle)
        ],
        "polygons": [
            {
                "version": _AREA_VERSION,
                "inclusion": area.inclusion,
                "polygon": [_degrees(vertex) for vertex in area.vertices],
            }
            for area in fence.areas
            if isinstance(area, FencePolygon)
        ],
    }
    if fence.return_point is not None:
        section["breachReturn"] = [*_degrees(fence.return_point), 0.0]
    return section


def rally_section(rally: Sequence[MissionItem]) -> dict[str, Any]:
    """The section `rallyPoints`."""
    return {"version": _VERSION, "points": [[item.lat_deg, item.lon_deg, item.alt_m] for item in rally]}


def read_fence_section(reader: JsonReader, section: Any) -> Fence:
    """The fence in a section `geoFence`; one without areas fences nothing.

    Version 1 has a single polygon, which is an area to stay in.

    Raises:
        InputError: what cannot be read, by its place.
    """
    table = reader.table(section, "geoFence", {"version", "polygons", "circles", "polygon", "breachReturn"})
    old = _version(reader, table, "geoFence") == 1
    areas: tuple[FencePolygon | FenceCircle, ...] = (*_polygons(reader, table), *_circles(reader, table))
    if table.get("polygon"):
        if not old or areas:
            raise reader.error("geoFence.polygon", "belongs in version 1; in version 2 write polygons")
        areas = (FencePolygon(True, _corners(reader, table["polygon"], "geoFence.polygon")),)
        reader.note("geoFence", "version 1: its polygon was read as an area to stay in")
    if table.get("breachReturn") is None:
        return Fence(areas)
    values = reader.array(table["breachReturn"], "geoFence.breachReturn")
    place = reader.numbers(values, "geoFence.breachReturn", 2 if len(values) == 2 else 3)
    return Fence(areas, reader.place_e7(place[:2], "geoFence.breachReturn"))


def _version(reader: JsonReader, table: dict[str, Any], key: str) -> int:
    """1 or 2; files without one are as the present ones."""
    version = reader.whole(table.get("version", _VERSION), f"{key}.version")
    if version not in (1, _VERSION):
        raise reader.error(f"{key}.version", f"must be 1 or {_VERSION}, got {version}")
    return version


def _polygons(reader: JsonReader, section: dict[str, Any]) -> Iterator[FencePolygon]:
    for index, entry in enumerate(reader.array(section.get("polygons", []), "geoFence.polygons")):
        key = f"geoFence.polygons[{index}]"
        table = _area(reader, entry, key, "polygon")
        vertices = _corners(reader, table.get("polygon"), f"{key}.polygon")
        yield FencePolygon(_inclusion(reader, table, key), vertices)


def _corners(reader: JsonReader, value: Any, key: str) -> tuple[LatLonE7, ...]:
    corners = reader.array(value, key)
    if len(corners) < LEAST_VERTICES:
        raise reader.error(key, f"must have at least {LEAST_VERTICES} corners, got {len(corners)}")
    return tuple(_fence_place(reader, corner, f"{key}[{n}]") for n, corner in enumerate(corners))


def _circles(reader: JsonReader, section: dict[str, Any]) -> Iterator[FenceCircle]:
    for index, entry in enumerate(reader.array(section.get("circles", []), "geoFence.circles")):
        key = f"geoFence.circles[{index}]"
        table = _area(reader, entry, key, "circle")
        circle = reader.table(table.get("circle"), f"{key}.circle", {"center", "radius"})
        radius_m = reader.finite(circle.get("radius"), f"{key}.circle.radius")
        if radius_m <= 0.0:
            raise reader.error(f"{key}.circle.radius", f"must be > 0, got {radius_m:g}")
        center = _fence_place(reader, circle.get("center"), f"{key}.circle.center")
        yield FenceCircle(_inclusion(reader, table, key), center, radius_m)


def _area(reader: JsonReader, entry: Any, key: str, shape: str) -> dict[str, Any]:
    table = reader.table(entry, key, {"version", "inclusion", shape})
    if (version := table.get("version", _AREA_VERSION)) != _AREA_VERSION:
        raise reader.error(f"{key}.version", f"must be {_AREA_VERSION}, got {version!r}")
    if table.get("altitudeBandEnabled"):
        raise reader.error(f"{key}.altitudeBandEnabled", "an area between two altitudes cannot be read; make it of all")
    return table


def _fence_place(reader: JsonReader, value: Any, key: str) -> LatLonE7:
    """A corner or a centre; null, which items may have, is none."""
    for index, number in enumerate(reader.numbers(value, key, 2)):
        reader.finite(None if number != number else number, f"{key}[{index}]")
    return reader.place_e7(value, key)


def _inclusion(reader: JsonReader, table: dict[str, Any], key: str) -> bool:
    inclusion = table.get("inclusion")
    if not isinstance(inclusion, bool):
        raise reader.error(f"{key}.inclusion", "must be true or false")
    return inclusion


def read_rally_section(reader: JsonReader, section: Any) -> tuple[MissionItem, ...]:
    """The rally points in a section `rallyPoints`. Raises InputError."""
    table = reader.table(section, "rallyPoints", {"version", "points"})
    _version(reader, table, "rallyPoints")
    points = []
    for index, entry in enumerate(reader.array(table.get("points", []), "rallyPoints.points")):
        key = f"rallyPoints.points[{index}]"
        latitude, longitude, altitude_m = reader.numbers(entry, key, 3)
        points.append((*_fence_place(reader, [latitude, longitude], key), reader.finite(altitude_m, f"{key}[2]")))
    return rally_items(points)


def _degrees(place: LatLonE7) -> list[float]:
    return [place[0] / 1e7, place[1] / 1e7]
