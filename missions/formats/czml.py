"""CZML: a plan over time for Cesium. Heights there are above the WGS84 ellipsoid; see `ELLIPSOID_NOTE`."""

import json
from datetime import datetime, timedelta
from pathlib import Path
from typing import Any

from missions.formats.files import write_text
from missions.formats.scene import (
    AREA_COLOUR,
    ELLIPSOID_NOTE,
    EPOCH,
    OBSTACLE_COLOUR,
    RADAR_COLOUR,
    Round,
    Scene,
    Track,
)

_OPAQUE, _GLASS = 255, 90
_TRAIL_S = 1e6
"""Long enough to show the whole way, behind and ahead."""


def write_czml(scene: Scene, path: Path) -> None:
    """Write a scene: a document with a clock, then a packet a vehicle, radar and obstacle. Raises InputError."""
    duration_s = max(float(track.time_s[-1]) for track in scene.tracks)
    end = datetime.fromisoformat(EPOCH) + timedelta(seconds=duration_s)
    interval = f"{EPOCH}/{end.isoformat(timespec='milliseconds').replace('+00:00', 'Z')}"
    document = {
        "id": "document",
        "name": scene.name,
        "version": "1.0",
        "description": f"{scene.description}\n{ELLIPSOID_NOTE}".strip(),
        "clock": {"interval": interval, "currentTime": EPOCH, "multiplier": 10, "range": "LOOP_STOP"},
    }
    packets = [
        document,
        *(_vehicle(track, interval) for track in scene.tracks),
        *(_sphere(radar) for radar in scene.radars),
        *(_cylinder(obstacle) for obstacle in scene.obstacles),
        _outline(scene),
    ]
    write_text(path, "[\n" + ",\n".join(json.dumps(packet, allow_nan=False) for packet in packets) + "\n]\n")


def _vehicle(track: Track, interval: str) -> dict[str, Any]:
    samples: list[float] = []
    columns = (track.time_s, track.lon_deg, track.lat_deg, track.alt_m)
    for time_s, lon_deg, lat_deg, alt_m in zip(*(column.tolist() for column in columns), strict=True):
        samples += [round(time_s, 3), round(lon_deg, 8), round(lat_deg, 8), round(alt_m, 2)]
    colour = _solid(track.colour, _OPAQUE)
    return {
        "id": f"vehicle/{track.sysid}",
        "name": f"{track.sysid} {track.name}",
        "availability": interval,
        "properties": {"sysid": track.sysid},
        "position": {"epoch": EPOCH, "interpolationAlgorithm": "LINEAR", "cartographicDegrees": samples},
        "path": {"width": 2, "leadTime": _TRAIL_S, "trailTime": _TRAIL_S, "material": {"solidColor": colour}},
        "point": {"pixelSize": 9, **colour},
        "label": {
            "text": track.name,
            "font": "11pt sans-serif",
            "fillColor": colour["color"],
            "horizontalOrigin": "LEFT",
            "pixelOffset": {"cartesian2": [10, 0]},
        },
    }


def _sphere(radar: Round) -> dict[str, Any]:
    return {
        **_standing(radar),
        "ellipsoid": {
            "radii": {"cartesian": [radar.radius_m] * 3},
            "material": {"solidColor": _solid(RADAR_COLOUR, _GLASS)},
        },
    }


def _cylinder(obstacle: Round) -> dict[str, Any]:
    return {
        **_standing(obstacle),
        "cylinder": {
            "length": obstacle.top_m - obstacle.bottom_m,
            "topRadius": obstacle.radius_m,
            "bottomRadius": obstacle.radius_m,
            "material": {"solidColor": _solid(OBSTACLE_COLOUR, _GLASS)},
        },
    }


def _standing(place: Round) -> dict[str, Any]:
    middle = [round(place.lon_deg, 8), round(place.lat_deg, 8), round(place.middle_m, 2)]
    return {"id": place.name.replace(" ", "/"), "name": place.name, "position": {"cartographicDegrees": middle}}


def _outline(scene: Scene) -> dict[str, Any]:
    places: list[float] = []
    for lat_deg, lon_deg in (*scene.area, scene.area[0]):
        places += [round(lon_deg, 8), round(lat_deg, 8), 0.0]
    line = {"width": 2, "clampToGround": True, "material": {"solidColor": _solid(AREA_COLOUR, _OPAQUE)}}
    return {"id": "area", "name": "Area", "polyline": {"positions": {"cartographicDegrees": places}, **line}}


def _solid(colour: str, opacity: int) -> dict[str, Any]:
    """ "#rrggbb" as a CZML colour."""
    return {"color": {"rgba": [int(colour[i : i + 2], 16) for i in (1, 3, 5)] + [opacity]}}
