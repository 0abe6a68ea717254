"""Places by latitude and longitude, as they are read off a map, in place of metres from a scenario's origin.

A point, `[x, y, z]` in metres, may be `{ lat_deg = ..., lon_deg = ..., alt_m = ... }` with an altitude AMSL, as that of
[origin]; what stands at `x_m` and `y_m`, an obstacle or a radar, may stand at `lat_deg` and `lon_deg`.
"""

from collections.abc import Mapping
from typing import Any

from pydantic import ValidationError

from missions.frame import LocalFrame
from missions.scenario.keys import Keys, Number
from missions.scenario.places import Latitude, Longitude, OriginModel


class GeodeticPoint(Keys):
    """A point of the globe; its altitude is AMSL."""

    lat_deg: Latitude
    lon_deg: Longitude
    alt_m: Number


def in_metres(data: Mapping[str, Any]) -> dict[str, Any]:
    """A scenario's tables with all places in the local frame. What is no place by degrees stays as it is.

    Raises:
        ValueError: such a place has other keys, or values that cannot be; the message begins with its key.
    """
    try:
        origin = OriginModel.model_validate(data.get("origin"))
    except ValidationError:
        return dict(data)  # told of as the origin's own
    frame = LocalFrame(origin.lat_deg, origin.lon_deg, origin.alt_m)
    placed = dict(data)
    for table in ("vehicles", "radars", "obstacles"):
        if isinstance(rows := data.get(table), list | tuple):
            placed[table] = [_row(row, f"{table}[{i}]", frame) for i, row in enumerate(rows)]
    if isinstance(route := data.get("route"), Mapping):
        placed["route"] = _ends(route, "route", frame)
        if isinstance(points := route.get("points"), list | tuple):
            placed["route"]["points"] = [_point(one, f"route.points[{i}]", frame) for i, one in enumerate(points)]
    return placed


def _row(row: Any, key: str, frame: LocalFrame) -> Any:
    """A vehicle, a radar or an obstacle."""
    if not isinstance(row, Mapping):
        return row
    if not {"lat_deg", "lon_deg"} & row.keys():
        return _ends(row, key, frame)
    if {"x_m", "y_m"} & row.keys():
        raise ValueError(f"{key}: stands at x_m and y_m or at lat_deg and lon_deg; leave two of them out")
    rest = {name: value for name, value in row.items() if name not in ("lat_deg", "lon_deg")}
    place = {name: row[name] for name in ("lat_deg", "lon_deg") if name in row}
    x_m, y_m, _ = _point({**place, "alt_m": frame.alt_m}, key, frame)
    return {**rest, "x_m": x_m, "y_m": y_m}


def _ends(row: Mapping[str, Any], key: str, frame: LocalFrame) -> dict[str, Any]:
    """What goes from an origin to a target."""
    return {
        name: _point(value, f"{key}.{name}", frame) if name in ("origin", "target") else value
        for name, value in row.items()
    }


def _point(value: Any, key: str, frame: LocalFrame) -> Any:
    if not isinstance(value, Mapping):
        return value
    try:
        point = GeodeticPoint.model_validate(value)
    except ValidationError as error:
        wrong = error.errors()[0]
        name, known = wrong["loc"][0], ", ".join(GeodeticPoint.model_fields)
        if wrong["type"] == "missing":
            raise ValueError(f"{key}.{name}: is missing; a place by degrees has {known}") from None
        if wrong["type"] == "extra_forbidden":
            raise ValueError(f"{key}.{name}: unknown key; a place by degrees has {known}") from None
        raise ValueError(f"{key}.{name}: {wrong['msg']}, got {wrong['input']!r}") from None
    return (*frame.to_local(point.lat_deg, point.lon_deg), point.alt_m - frame.alt_m)
