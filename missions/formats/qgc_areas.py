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
    """The fence in a section `geoFence`; one without areas fences nothing. Raises InputError."""
    table = reader.table(section, "geoFence")
    areas: tuple[FencePolygon | FenceCircle, ...] = (*_polygons(reader, table), *_circles(reader, table))
    if table.get("breachReturn") is None:
        return Fence(areas)
    latitude, longitude, _ = reader.numbers(table["breachReturn"], "geoFence.breachReturn", 3)
    return Fence(areas, reader.place_e7([latitude, longitude], "geoFence.breachReturn"))


def _polygons(reader: JsonReader, section: dict[str, Any]) -> Iterator[FencePolygon]:
    for index, entry in enumerate(reader.array(section.get("polygons", []), "geoFence.polygons")):
        key = f"geoFence.polygons[{index}]"
        table = reader.table(entry, key)
        corners = reader.array(table.get("polygon"), f"{key}.polygon")
        if len(corners) < LEAST_VERTICES:
            raise reader.error(f"{key}.polygon", f"must have at least {LEAST_VERTICES} corners, got {len(corners)}")
        vertices = tuple(reader.place_e7(corner, f"{key}.polygon[{n}]") for n, corner in enumerate(corners))
        yield FencePolygon(_inclusion(reader, table, key), vertices)


def _circles(reader: JsonReader, section: dict[str, Any]) -> Iterator[FenceCircle]:
    for index, entry in enumerate(reader.array(section.get("circles", []), "geoFence.circles")):
        key = f"geoFence.circles[{index}]"
        table = reader.table(entry, key)
        circle = reader.table(table.get("circle"), f"{key}.circle")
        radius_m = reader.finite(circle.get("radius"), f"{key}.circle.radius")
        if radius_m <= 0.0:
            raise reader.error(f"{key}.circle.radius", f"must be > 0, got {radius_m:g}")
        center = reader.place_e7(circle.get("center"), f"{key}.circle.center")
        yield FenceCircle(_inclusion(reader, table, key), center, radius_m)


def _inclusion(reader: JsonReader, table: dict[str, Any], key: str) -> bool:
    inclusion = table.get("inclusion")
    if not isinstance(inclusion, bool):
        raise reader.error(f"{key}.inclusion", "must be true or false")
    return inclusion


def read_rally_section(reader: JsonReader, section: Any) -> tuple[MissionItem, ...]:
    """The rally points in a section `rallyPoints`. Raises InputError."""
    table = reader.table(section, "rallyPoints")
    points = []
    for index, entry in enumerate(reader.array(table.get("points", []), "rallyPoints.points")):
        key = f"rallyPoints.points[{index}]"
        latitude, longitude, altitude_m = reader.numbers(entry, key, 3)
        points.append((*reader.place_e7([latitude, longitude], key), reader.finite(altitude_m, f"{key}[2]")))
    return rally_items(points)


def _degrees(place: LatLonE7) -> list[float]:
    return [place[0] / 1e7, place[1] / 1e7]
