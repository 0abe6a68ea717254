"""`.plan` files written: QGroundControl's JSON with a mission, a fence and rally points."""

import json
import math
from pathlib import Path
from typing import Any

from missions.autopilot import Autopilot
from missions.commands import PLACES, Command, Frame
from missions.errors import InputError
from missions.formats.files import write_text
from missions.formats.qgc_areas import fence_section, rally_section
from missions.mission import MissionItem
from missions.vehicle_plan import Plan

_VEHICLE_FIXED_WING = 1
_ALTITUDE_MODES = {int(Frame.GLOBAL_RELATIVE_ALT): 1, int(Frame.GLOBAL): 2, int(Frame.GLOBAL_TERRAIN_ALT): 4}
"""QGroundControl's AltitudeMode of a frame: without it, it takes frame 10 for altitudes AMSL."""
_ALTITUDE_MODE_MIXED = 0
_HOVER_SPEED_M_S = 5.0  # of no use to a plane, but the format wants it


def write_plan(plan: Plan, path: Path, *, cruise_speed_m_s: float, autopilot: Autopilot = Autopilot.ardupilot) -> None:
    """Write a plan; `read_plan` gives back an equal one, but for the order of areas: polygons come first.

    Args:
        plan: its home is written as a position, so it must be a plain NAV_WAYPOINT in frame 0.
        path: the file.
        cruise_speed_m_s: what QGroundControl reckons flight times with.
        autopilot: whose dialect the plan is in.

    Raises:
        InputError: the file cannot be written or the format cannot hold the mission.
    """
    mission = plan.mission
    home = mission.home
    if home != home_item(home.lat_e7, home.lon_e7, home.alt_m):
        raise InputError(f"{path}: item 0: home must be a NAV_WAYPOINT in frame 0 without parameters")
    modes = {mode for item in mission.items[1:] if (mode := _altitude_mode(item)) is not None}
    contents = {
        "fileType": "Plan",
        "version": 1,
        "groundStation": "Skein",
        "mission": {
            "version": 2,
            "firmwareType": autopilot.mav_autopilot,
            "vehicleType": _VEHICLE_FIXED_WING,
            "cruiseSpeed": cruise_speed_m_s,
            "hoverSpeed": _HOVER_SPEED_M_S,
            "globalPlanAltitudeMode": modes.pop() if len(modes) == 1 else _ALTITUDE_MODE_MIXED,
            "plannedHomePosition": [home.lat_deg, home.lon_deg, home.alt_m],
            "items": [_simple_item(seq, mission[seq]) for seq in range(1, len(mission))],
        },
        "geoFence": fence_section(plan.fence),
        "rallyPoints": rally_section(plan.rally),
    }
    try:
        text = json.dumps(contents, indent=4, allow_nan=False)
    except ValueError as error:
        raise InputError(f"{path}: an infinite or undefined position or speed cannot be written as JSON") from error
    write_text(path, text + "\n")


def home_item(lat_e7: int, lon_e7: int, alt_m: float) -> MissionItem:
    """A planned home position as item 0."""
    return MissionItem(Command.NAV_WAYPOINT, Frame.GLOBAL, lat_e7=lat_e7, lon_e7=lon_e7, alt_m=alt_m)


def _altitude_mode(item: MissionItem) -> int | None:
    return _ALTITUDE_MODES.get(item.frame) if item.command in PLACES else None


def _simple_item(seq: int, item: MissionItem) -> dict[str, Any]:
    params = [None if math.isnan(value) else value for value in item.params]
    simple = {
        "type": "SimpleItem",
        "frame": item.frame,
        "command": item.command,
        "params": [*params, item.lat_deg, item.lon_deg, item.alt_m],
        "autoContinue": item.autocontinue,
        "doJumpId": seq,
    }
    mode = _altitude_mode(item)
    if mode is None:
        return simple
    return simple | {"AltitudeMode": mode, "Altitude": item.alt_m, "AMSLAltAboveTerrain": None}
