"""What PX4 wants of a fixed wing's mission: the checks of its navigator, and what it stores."""

import math
from collections.abc import Sequence
from dataclasses import replace

from missions.altitude_frame import altitudes_amsl_m
from missions.commands import PLACES, Command, Frame
from missions.errors import InputError
from missions.frame import LocalFrame
from missions.mission import Mission, MissionItem

GLIDE_SLOPE_MAX = math.tan(math.radians(5.0))
"""Steepest landing: the default of FW_LND_ANG."""
TAKEOFF_AHEAD_M = 300.0
"""From home to the take-off's place, at most half of the first leg: PX4 climbs out towards it."""

_WITHOUT_PLACE = frozenset(
    {Command.DO_CHANGE_SPEED, Command.DO_LAND_START, Command.DO_JUMP, Command.NAV_RETURN_TO_LAUNCH}
)
_REFUSED = frozenset({Command.NAV_LOITER_TURNS})
_APPROACHES = frozenset({Command.NAV_WAYPOINT, Command.NAV_LOITER_TO_ALT})

_VTOL_TAKEOFF, _VTOL_LAND = 84, 85
_KEPT = {
    int(Command.NAV_WAYPOINT): (1, 2, 4),
    int(Command.NAV_LOITER_UNLIM): (3, 4),
    int(Command.NAV_LOITER_TIME): (1, 2, 3, 4),
    int(Command.NAV_LAND): (2, 4),
    int(Command.NAV_TAKEOFF): (4,),
    int(Command.NAV_LOITER_TO_ALT): (1, 2, 4),
    _VTOL_TAKEOFF: (4,),
    _VTOL_LAND: (4,),
}
"""The parameters that PX4 keeps of items with a place (its mavlink_mission.cpp); of items in frame MISSION all."""
_FLAGS = {int(Command.NAV_LOITER_TIME): (2, 4), int(Command.NAV_LOITER_TO_ALT): (1, 4)}
"""Those of them of which it keeps whether they are positive; param4 of all others is a heading."""


def px4_mission(mission: Mission) -> Mission:
    """A mission as PX4 takes it, home still item 0: what has no place in frame MISSION, the take-off ahead of home.

    Raises:
        InputError: PX4 would reject it; the message names the item.
    """
    items = [mission.home]
    for seq, item in enumerate(mission.items[1:], start=1):
        if item.command in _REFUSED:
            raise InputError(f"mission item {seq}: PX4 has no command {item.command}; use a NAV_LOITER_UNLIM or _TIME")
        if item.frame == Frame.GLOBAL_TERRAIN_ALT:
            raise InputError(f"mission item {seq}: PX4 has no altitudes above terrain; use amsl or relative")
        if item.command in PLACES and (item.lat_e7, item.lon_e7) == (0, 0):
            raise InputError(f"mission item {seq}: latitude and longitude 0 is a place to PX4; give it one")
        if item.command in _WITHOUT_PLACE:
            item = replace(item, frame=Frame.MISSION, lat_e7=0, lon_e7=0, alt_m=0.0)
        items.append(item)
    changed = Mission(tuple(items))
    altitudes_m = altitudes_amsl_m(changed, _no_ground)
    _check_landing(changed, altitudes_m)
    return _with_takeoff_ahead(changed, altitudes_m)


def px4_items(mission: Mission) -> tuple[MissionItem, ...]:
    """The items that PX4 is sent: without home, and jumps counted without it."""
    return tuple(
        replace(item, param1=item.param1 - 1.0) if item.command == Command.DO_JUMP else item
        for item in mission.items[1:]
    )


def mission_of_px4(items: Sequence[MissionItem], home: MissionItem) -> Mission:
    """What PX4 holds as a mission that begins with home, and whose jumps count it: the reverse of `px4_items`."""
    own = (replace(item, param1=item.param1 + 1.0) if item.command == Command.DO_JUMP else item for item in items)
    return Mission((home, *own))


def px4_kept(item: MissionItem) -> MissionItem:
    """An item as PX4 gives it back."""
    kept = _KEPT.get(item.command)
    if kept is None or item.frame == Frame.MISSION:
        return item
    flags = _FLAGS.get(item.command, ())
    params = [value if number in kept else 0.0 for number, value in enumerate(item.params, start=1)]
    for number in flags:
        params[number - 1] = float(params[number - 1] > 0.0)
    if 4 not in flags:
        params[3] = round(params[3], 3) % 360.0
    first, second, third, fourth = params
    return replace(item, param1=first, param2=second, param3=third, param4=fourth)


def _no_ground(lat_e7: int, lon_e7: int) -> float:
    raise AssertionError("altitudes above terrain were refused")


def _check_landing(mission: Mission, altitudes_m: list[float]) -> None:
    for seq, item in enumerate(mission):
        if item.command != Command.NAV_LAND:
            continue
        before = mission[seq - 1]
        if seq < 2 or before.command not in _APPROACHES:
            raise InputError(f"mission item {seq}: PX4 lands only after a waypoint or a loiter to altitude; add one")
        height_m = altitudes_m[seq - 1] - altitudes_m[seq]
        if height_m <= 0.0:
            raise InputError(f"mission item {seq - 1}: the landing's approach must be above it; raise it")
        distance_m = math.hypot(*_offset_m(item, before))
        if before.command == Command.NAV_LOITER_TO_ALT:
            if distance_m <= abs(before.param2):
                raise InputError(f"mission item {seq}: lands inside the circle of its approach; move it out")
            distance_m = math.sqrt(distance_m**2 - before.param2**2)
        if height_m > GLIDE_SLOPE_MAX * distance_m:
            raise InputError(
                f"mission item {seq}: {height_m:.0f} m down in {distance_m:.0f} m is steeper than PX4's 5 degrees; "
                "begin the approach lower or farther away"
            )


def _with_takeoff_ahead(mission: Mission, altitudes_m: list[float]) -> Mission:
    places = [seq for seq, item in enumerate(mission) if seq > 0 and item.command in PLACES]
    takeoffs = [seq for seq in places if mission[seq].command == Command.NAV_TAKEOFF]
    if not takeoffs:
        return mission
    first = takeoffs[0]
    if first != places[0] or len(takeoffs) > 1:
        raise InputError(f"mission item {takeoffs[-1]}: to PX4 the take-off is the first item with a place; move it")
    takeoff, home = mission[first], mission.home
    if altitudes_m[first] <= home.alt_m:
        raise InputError(f"mission item {first}: the take-off must end above home; raise it")
    if len(places) > 1 and (takeoff.lat_e7, takeoff.lon_e7) == (home.lat_e7, home.lon_e7):
        x, y = _offset_m(home, mission[places[1]])
        if (leg_m := math.hypot(x, y)) > 0.0:
            part = min(TAKEOFF_AHEAD_M / leg_m, 0.5)
            lat_e7, lon_e7 = LocalFrame(home.lat_deg, home.lon_deg, 0.0).to_e7(x * part, y * part)
            takeoff = replace(takeoff, lat_e7=lat_e7, lon_e7=lon_e7)
    return Mission((*mission.items[:first], takeoff, *mission.items[first + 1 :]))


def _offset_m(origin: MissionItem, item: MissionItem) -> tuple[float, float]:
    """(east, north) of an item from another, in metres."""
    return LocalFrame(origin.lat_deg, origin.lon_deg, 0.0).from_e7(item.lat_e7, item.lon_e7)
