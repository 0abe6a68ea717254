"""What altitudes are above: the sea, home, or the ground. Missions converted from one to the other."""

import math
from collections.abc import Callable, Iterator
from dataclasses import replace
from enum import StrEnum

from missions.commands import PLACES, Command, Frame
from missions.errors import InputError
from missions.mission import Mission, MissionItem


class AltitudeFrame(StrEnum):
    """What a mission's altitudes are above."""

    amsl = "amsl"
    relative = "relative"
    terrain = "terrain"


GroundAmsl = Callable[[int, int], float]
"""Altitude AMSL of the ground in metres, at a latitude and a longitude in 1e-7 degrees."""

_FRAMES = {
    AltitudeFrame.amsl: Frame.GLOBAL,
    AltitudeFrame.relative: Frame.GLOBAL_RELATIVE_ALT,
    AltitudeFrame.terrain: Frame.GLOBAL_TERRAIN_ALT,
}
_ABOVE_HOME = frozenset({Command.NAV_TAKEOFF, Command.NAV_LAND, Command.NAV_LOITER_TO_ALT})
"""Stay above home where the rest is above the ground: autopilots take off to, and land from, a height above home."""


def in_altitude_frame(mission: Mission, altitude: AltitudeFrame, ground_amsl_m: GroundAmsl) -> Mission:
    """The same flight with its altitudes in another frame; home stays AMSL.

    Raises:
        InputError: an item's frame is none of the three.
    """
    items = [mission.home]
    for item, amsl in zip(mission.items[1:], altitudes_amsl_m(mission, ground_amsl_m)[1:], strict=True):
        if math.isnan(amsl):
            items.append(item)
            continue
        above_home = altitude is AltitudeFrame.terrain and item.command in _ABOVE_HOME
        frame = _FRAMES[AltitudeFrame.relative if above_home else altitude]
        zero = _zero_amsl_m(frame, item, mission.home, ground_amsl_m)
        items.append(replace(item, frame=frame, alt_m=amsl - zero))
    return Mission(tuple(items))


def altitudes_amsl_m(mission: Mission, ground_amsl_m: GroundAmsl) -> list[float]:
    """Altitude AMSL of each item in metres; NaN where the item has no place.

    Raises:
        InputError: an item's frame is none that altitudes are counted in.
    """
    return list(_altitudes(mission, ground_amsl_m))


def _altitudes(mission: Mission, ground_amsl_m: GroundAmsl) -> Iterator[float]:
    for seq, item in enumerate(mission):
        if item.command not in PLACES:
            yield math.nan
            continue
        if item.frame not in _FRAMES.values():
            raise InputError(f"mission item {seq}: frame {item.frame} has no altitude; use 0 (AMSL), 3 (home) or 10")
        yield item.alt_m + _zero_amsl_m(item.frame, item, mission.home, ground_amsl_m)


def _zero_amsl_m(frame: int, item: MissionItem, home: MissionItem, ground_amsl_m: GroundAmsl) -> float:
    """Where altitude 0 of a frame lies at an item's place; latitude and longitude 0 are taken for home."""
    if frame == Frame.GLOBAL_RELATIVE_ALT:
        return home.alt_m
    if frame == Frame.GLOBAL_TERRAIN_ALT:
        place = item if (item.lat_e7, item.lon_e7) != (0, 0) else home
        return ground_amsl_m(place.lat_e7, place.lon_e7)
    return 0.0
