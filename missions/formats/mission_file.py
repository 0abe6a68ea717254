"""A mission file of any station: recognised by what is in it, read, and looked over."""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path

from missions.autopilot import Autopilot
from missions.commands import LAST_NAV, LOCAL_FRAMES, Command, Frame
from missions.errors import InputError
from missions.formats.files import read_text
from missions.formats.qgc_plan import home_item
from missions.formats.qgc_plan_reader import ComplexItems, autopilot_of, read_plan
from missions.formats.waypoints_reader import read_waypoints
from missions.mission import MissionItem, degrees_to_e7
from missions.vehicle_plan import Plan

_PLACELESS = frozenset({Command.NAV_RETURN_TO_LAUNCH, 30, 92, 93})
"""NAV commands without a place: RETURN_TO_LAUNCH, CONTINUE_AND_CHANGE_ALT, GUIDED_ENABLE, DELAY."""
_LATITUDE_E7, _LONGITUDE_E7 = 90 * 10**7, 180 * 10**7


@dataclass(frozen=True)
class MissionFile:
    """What a file held.

    Attributes:
        path: of the file.
        plan: mission, fence and rally points; item 0 is a plain home position.
        notes: what was read otherwise than it stands in the file, or left out, a line each.
        autopilot: whose dialect it says that it is in; None when it does not say.
    """

    path: Path
    plan: Plan
    notes: tuple[str, ...]
    autopilot: Autopilot | None = None


def read_mission_file(
    path: Path, *, home: MissionItem | None = None, complex_items: ComplexItems = "refuse"
) -> MissionFile:
    """Read a `.plan`, `.mission` or `.waypoints` file, whatever it is called.

    Args:
        path: the file.
        home: item 0 in place of the file's own.
        complex_items: what to do with what is no simple item.

    Raises:
        InputError: the file cannot be read; the message names the line, the place in the JSON, or the item.
    """
    notes: list[str] = []
    autopilot = None
    beginning = read_text(path).lstrip()
    if beginning.startswith(("{", "//", "/*")):
        plan = read_plan(path, home=home, complex_items=complex_items, note=notes.append)
        autopilot = autopilot_of(path)
    elif beginning.startswith("QGC"):
        plan = Plan(read_waypoints(path, home=home))
    else:
        raise InputError(
            f"{path}: line 1: neither a plan (QGroundControl's JSON) nor a list of waypoints ('QGC WPL 110')"
        )
    plain = _plain_home(plan.mission.home, path, notes.append)
    for seq, item in enumerate(plan.mission.items[1:], start=1):
        if (reason := _misplaced(item)) is not None:
            raise InputError(f"{path}: item {seq} (command {item.command}): {reason}")
    return MissionFile(path, replace(plan, mission=plan.mission.with_home(plain)), tuple(notes), autopilot)


def home_at(text: str) -> MissionItem:
    """The home position in "LAT,LON,ALT", degrees and metres above sea. Raises InputError."""
    try:
        latitude, longitude, altitude_m = map(float, text.split(","))
    except ValueError:
        raise InputError(f"--home {text}: must be LAT,LON,ALT, such as 47.4,8.5,450") from None
    if not (abs(latitude) <= 90.0 and abs(longitude) <= 180.0 and math.isfinite(altitude_m)):
        raise InputError(f"--home {text}: no such place; LAT,LON,ALT are degrees and metres above sea")
    return home_item(degrees_to_e7(latitude), degrees_to_e7(longitude), altitude_m)


def _plain_home(home: MissionItem, path: Path, note: Callable[[str], None]) -> MissionItem:
    """Item 0 as stations mean it, whatever else stands in its row: a position, its altitude above sea."""
    if home.command not in (0, Command.NAV_WAYPOINT) or home.frame in (*LOCAL_FRAMES, Frame.MISSION):
        raise InputError(
            f"{path}: row 0: is home, and must be a NAV_WAYPOINT (16) in frame 0, got command {home.command} in frame "
            f"{home.frame}; put a row with the home position before it"
        )
    plain = home_item(home.lat_e7, home.lon_e7, home.alt_m)
    if not math.isfinite(plain.alt_m) or (reason := _misplaced(plain)) is not None:
        why = "home has no altitude" if not math.isfinite(plain.alt_m) else f"home: {reason}"
        raise InputError(f"{path}: {why}; say where home is with --home LAT,LON,ALT")
    if home.frame != Frame.GLOBAL:
        note(f"home: in frame {home.frame}; its altitude was read as above sea, as all stations do")
    if home.lat_e7 == 0 and home.lon_e7 == 0:
        note("home: latitude and longitude are 0, which stations write for a home that is not known; see --home")
    return plain


def _misplaced(item: MissionItem) -> str | None:
    """Why an item's place is nowhere."""
    if item.command > LAST_NAV or item.command in _PLACELESS or item.frame in (*LOCAL_FRAMES, Frame.MISSION):
        return None
    if abs(item.lat_e7) > _LATITUDE_E7:
        return f"latitude {item.lat_deg:g} is none; degrees are -90 to 90"
    if abs(item.lon_e7) > _LONGITUDE_E7:
        return f"longitude {item.lon_deg:g} is none; degrees are -180 to 180"
    return None if math.isfinite(item.alt_m) else "it has no altitude"
