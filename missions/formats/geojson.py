"""GeoJSON (RFC 7946): a plan for maps and scripts. Its heights should be above the ellipsoid; see `ELLIPSOID_NOTE`."""

import json
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

from missions.formats.files import write_text
from missions.formats.scene import ELLIPSOID_NOTE, LatLon, Round, Scene, Track


def write_geojson(scene: Scene, path: Path) -> None:
    """Write a scene as a FeatureCollection, one feature a line; `kind` tells them apart. Raises InputError."""
    features = ",\n".join(json.dumps(feature, allow_nan=False) for feature in _features(scene))
    head = {
        "type": "FeatureCollection",
        "name": scene.name,
        "description": f"{scene.description}\n{ELLIPSOID_NOTE}".strip(),
    }
    write_text(path, json.dumps(head)[:-1] + ', "features": [\n' + features + "\n]}\n")


def _features(scene: Scene) -> Iterator[dict[str, Any]]:
    for track in scene.tracks:
        yield _way(track)
        yield from _stops(track)
    for kind, places in (("radar", scene.radars), ("obstacle", scene.obstacles)):
        for place in places:
            yield _feature("Polygon", [_ring(place.rim)], kind=kind, **_round_properties(place))
    yield _feature("Polygon", [_ring(scene.area)], kind="area", name="Area")


def _way(track: Track) -> dict[str, Any]:
    columns = (track.lat_deg, track.lon_deg, track.alt_m)
    places = [_position(*row) for row in zip(*(column.tolist() for column in columns), strict=True)]
    return _feature(
        "LineString",
        places,
        kind="way",
        sysid=track.sysid,
        name=track.name,
        stroke=track.colour,
        times_s=[round(time_s, 3) for time_s in track.time_s.tolist()],
        ground_speeds_m_s=[round(speed_m_s, 2) for speed_m_s in track.speed_m_s.tolist()],
    )


def _stops(track: Track) -> Iterator[dict[str, Any]]:
    for stop in track.stops:
        yield _feature(
            "Point",
            _position(stop.lat_deg, stop.lon_deg, stop.alt_m),
            kind="item",
            sysid=track.sysid,
            name=f"{track.name} {stop.seq} {stop.name}",
            item=stop.seq,
            altitude_amsl_m=round(stop.alt_m, 2),
            airspeed_m_s=stop.airspeed_m_s,
            time_s=None if stop.time_s is None else round(stop.time_s, 3),
            acceptance_m=stop.acceptance_m,
        )


def _round_properties(place: Round) -> dict[str, Any]:
    return {
        "name": place.name,
        "center": [round(place.lon_deg, 8), round(place.lat_deg, 8)],
        "radius_m": place.radius_m,
        "bottom_amsl_m": round(place.bottom_m, 2),
        "top_amsl_m": round(place.top_m, 2),
    }


def _feature(geometry: str, coordinates: Any, **properties: Any) -> dict[str, Any]:
    return {
        "type": "Feature",
        "geometry": {"type": geometry, "coordinates": coordinates},
        "properties": properties,
    }


def _position(lat_deg: float, lon_deg: float, alt_m: float) -> list[float]:
    return [round(lon_deg, 8), round(lat_deg, 8), round(alt_m, 2)]


def _ring(places: Sequence[LatLon]) -> list[list[float]]:
    return [[round(lon_deg, 8), round(lat_deg, 8)] for lat_deg, lon_deg in (*places, places[0])]
