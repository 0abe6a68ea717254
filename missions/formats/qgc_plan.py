"""`.plan` files: QGroundControl's JSON with a mission, a fence and rally points."""

import json
import math
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from missions.commands import Command, Frame
from missions.errors import InputError
from missions.fence import NO_FENCE, Fence
from missions.formats.files import read_text, write_text
from missions.formats.json_reader import JsonReader
from missions.formats.qgc_areas import fence_section, rally_section, read_fence_section, read_rally_section
from missions.mission import Mission, MissionItem

_FIRMWARE_ARDUPILOT = 3
_VEHICLE_FIXED_WING = 1
_ALTITUDE_MODE_ABSOLUTE = 2
_HOVER_SPEED_M_S = 5.0  # of no use to a plane, but the format wants it
_PARAMS = 7


@dataclass(frozen=True)
class Plan:
    """All that one vehicle can be given.

    Attributes:
        mission: home first.
        fence: where it may be.
        rally: rally points, NAV_RALLY_POINT items.
    """

    mission: Mission
    fence: Fence = NO_FENCE
    rally: tuple[MissionItem, ...] = ()


def write_plan(plan: Plan, path: Path, *, cruise_speed_m_s: float) -> None:
    """Write a plan; `read_plan` gives back an equal one, but for the order of areas: polygons come first.

    Args:
        plan: its home is written as a position, so it must be a plain NAV_WAYPOINT in frame 0.
        path: the file.
        cruise_speed_m_s: what QGroundControl reckons flight times with.

    Raises:
        InputError: the file cannot be written or the format cannot hold the mission.
    """
    mission = plan.mission
    home = mission.home
    if home != _home_item(home.lat_e7, home.lon_e7, home.alt_m):
        raise InputError(f"{path}: item 0: home must be a NAV_WAYPOINT in frame 0 without parameters")
    contents = {
        "fileType": "Plan",
        "version": 1,
        "groundStation": "Skein",
        "mission": {
            "version": 2,
            "firmwareType": _FIRMWARE_ARDUPILOT,
            "vehicleType": _VEHICLE_FIXED_WING,
            "cruiseSpeed": cruise_speed_m_s,
            "hoverSpeed": _HOVER_SPEED_M_S,
            "globalPlanAltitudeMode": _ALTITUDE_MODE_ABSOLUTE,
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


def read_plan(path: Path) -> Plan:
    """Read a plan, the mission's planned home position as item 0.

    Raises:
        InputError: what cannot be read, by its place in the JSON; complex items are refused.
    """
    try:
        contents = json.loads(read_text(path))
    except json.JSONDecodeError as error:
        raise InputError(f"{path}: line {error.lineno}: not JSON: {error.msg}; export the plan again") from error
    reader = JsonReader(path)
    root = reader.table(contents, "the file")
    if root.get("fileType") != "Plan":
        raise InputError(f"{path}: fileType: must be 'Plan', got {root.get('fileType')!r}")
    mission = reader.table(root.get("mission"), "mission")
    home = reader.numbers(mission.get("plannedHomePosition"), "mission.plannedHomePosition", 3)
    lat_e7, lon_e7 = (reader.e7(home[index], f"mission.plannedHomePosition[{index}]") for index in (0, 1))
    items = [_home_item(lat_e7, lon_e7, home[2])]
    for index, entry in enumerate(reader.array(mission.get("items"), "mission.items")):
        items.append(_read_item(reader, entry, f"mission.items[{index}]"))
    fence = read_fence_section(reader, root.get("geoFence", {}))
    return Plan(Mission(tuple(items)), fence, read_rally_section(reader, root.get("rallyPoints", {})))


def _home_item(lat_e7: int, lon_e7: int, alt_m: float) -> MissionItem:
    return MissionItem(Command.NAV_WAYPOINT, Frame.GLOBAL, lat_e7=lat_e7, lon_e7=lon_e7, alt_m=alt_m)


def _simple_item(seq: int, item: MissionItem) -> dict[str, Any]:
    params = [None if math.isnan(value) else value for value in item.params]
    return {
        "type": "SimpleItem",
        "frame": item.frame,
        "command": item.command,
        "params": [*params, item.lat_deg, item.lon_deg, item.alt_m],
        "autoContinue": item.autocontinue,
        "doJumpId": seq,
    }


def _read_item(reader: JsonReader, entry: Any, key: str) -> MissionItem:
    item = reader.table(entry, key)
    kind = item.get("type")
    if kind == "ComplexItem":
        name = item.get("complexItemType", "unnamed")
        raise reader.error(key, f"ComplexItem {name!r} cannot be read; replace it by simple items")
    if kind != "SimpleItem":
        raise reader.error(key + ".type", f"must be 'SimpleItem', got {kind!r}")
    params = reader.numbers(item.get("params"), key + ".params", _PARAMS)
    return MissionItem(
        command=reader.whole(item.get("command"), key + ".command"),
        frame=reader.whole(item.get("frame"), key + ".frame"),
        param1=params[0],
        param2=params[1],
        param3=params[2],
        param4=params[3],
        lat_e7=reader.e7(params[4], key + ".params[4]"),
        lon_e7=reader.e7(params[5], key + ".params[5]"),
        alt_m=params[6],
        autocontinue=item.get("autoContinue") is not False,
    )
