"""A geofence: where a vehicle must stay, and where it must not go (mission_type 1)."""

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

from missions.commands import Command, Frame
from missions.errors import InputError
from missions.mission import MissionItem

LEAST_VERTICES = 3

_POLYGONS = {
    int(Command.NAV_FENCE_POLYGON_VERTEX_INCLUSION): True,
    int(Command.NAV_FENCE_POLYGON_VERTEX_EXCLUSION): False,
}
_CIRCLES = {int(Command.NAV_FENCE_CIRCLE_INCLUSION): True, int(Command.NAV_FENCE_CIRCLE_EXCLUSION): False}

LatLonE7 = tuple[int, int]
"""Latitude and longitude in 1e-7 degrees."""


@dataclass(frozen=True)
class FencePolygon:
    """An area to stay in (`inclusion`) or out of, by its corners."""

    inclusion: bool
    vertices: tuple[LatLonE7, ...]


@dataclass(frozen=True)
class FenceCircle:
    """A circle to stay in (`inclusion`) or out of."""

    inclusion: bool
    center: LatLonE7
    radius_m: float


@dataclass(frozen=True)
class Fence:
    """All areas of one vehicle, in the order of their items, and the old protocol's return point, if it has one."""

    areas: tuple[FencePolygon | FenceCircle, ...] = ()
    return_point: LatLonE7 | None = None


NO_FENCE = Fence()


def parse_fence(items: Sequence[MissionItem]) -> Fence:
    """The fence in a list of items; polygon vertices say in param1 how many there are of them, circles their radius.

    Raises:
        InputError: an item is none of a fence, a polygon has too few vertices, or a radius is not positive.
    """
    areas: list[FencePolygon | FenceCircle] = []
    return_point: LatLonE7 | None = None
    seq = 0
    while seq < len(items):
        item = items[seq]
        if item.command in _POLYGONS:
            vertices = _polygon(items, seq)
            areas.append(FencePolygon(_POLYGONS[item.command], vertices))
            seq += len(vertices)
            continue
        if item.command in _CIRCLES:
            if not (math.isfinite(item.param1) and item.param1 > 0.0):
                raise InputError(f"fence item {seq}: radius must be positive, got {item.param1:g} m")
            areas.append(FenceCircle(_CIRCLES[item.command], (item.lat_e7, item.lon_e7), item.param1))
        elif item.command == Command.NAV_FENCE_RETURN_POINT:
            return_point = (item.lat_e7, item.lon_e7)
        else:
            raise InputError(f"fence item {seq}: command {item.command} is none of a fence")
        seq += 1
    return Fence(tuple(areas), return_point)


def _polygon(items: Sequence[MissionItem], first: int) -> tuple[LatLonE7, ...]:
    """The vertices of the polygon that begins at item `first`."""
    head = items[first]
    if not (math.isfinite(head.param1) and head.param1 >= LEAST_VERTICES):
        raise InputError(f"fence item {first}: a polygon needs at least {LEAST_VERTICES} vertices, got {head.param1:g}")
    vertices = items[first : first + int(head.param1)]
    for seq, item in enumerate(vertices, start=first):
        if item.command != head.command or item.param1 != head.param1:
            raise InputError(f"fence item {seq}: should be a vertex of the polygon of {head.param1:g} at item {first}")
    if len(vertices) < head.param1:
        raise InputError(f"fence item {first}: {len(vertices)} of {head.param1:g} vertices")
    return tuple((item.lat_e7, item.lon_e7) for item in vertices)


def fence_items(fence: Fence) -> tuple[MissionItem, ...]:
    """The items that carry a fence; `parse_fence` gives back an equal one."""
    return tuple(_items(fence))


def _items(fence: Fence) -> Iterator[MissionItem]:
    if fence.return_point is not None:
        yield _item(Command.NAV_FENCE_RETURN_POINT, 0.0, fence.return_point)
    for area in fence.areas:
        if isinstance(area, FenceCircle):
            inside, outside = Command.NAV_FENCE_CIRCLE_INCLUSION, Command.NAV_FENCE_CIRCLE_EXCLUSION
            yield _item(inside if area.inclusion else outside, area.radius_m, area.center)
            continue
        inside, outside = Command.NAV_FENCE_POLYGON_VERTEX_INCLUSION, Command.NAV_FENCE_POLYGON_VERTEX_EXCLUSION
        for vertex in area.vertices:
            yield _item(inside if area.inclusion else outside, float(len(area.vertices)), vertex)


def _item(command: Command, param1: float, place: LatLonE7) -> MissionItem:
    return MissionItem(command, Frame.GLOBAL, param1, lat_e7=place[0], lon_e7=place[1])


def rally_items(points: Iterable[tuple[int, int, float]]) -> tuple[MissionItem, ...]:
    """Rally points (lat_e7, lon_e7, metres above home) as items (mission_type 2)."""
    return tuple(
        MissionItem(Command.NAV_RALLY_POINT, Frame.GLOBAL_RELATIVE_ALT, lat_e7=lat_e7, lon_e7=lon_e7, alt_m=alt_m)
        for lat_e7, lon_e7, alt_m in points
    )
