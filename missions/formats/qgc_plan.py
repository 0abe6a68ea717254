"""`.plan` files: QGroundControl's JSON, the mission section; fences and rally points are empty."""

import json
import math
from pathlib import Path
from typing import Any

from missions.commands import Command, Frame
from missions.errors import InputError
from missions.formats.files import read_text, write_text
from missions.mission import Mission, MissionItem, degrees_to_e7

_FIRMWARE_ARDUPILOT = 3
_VEHICLE_FIXED_WING = 1
_ALTITUDE_MODE_ABSOLUTE = 2
_HOVER_SPEED_M_S = 5.0  # of no use to a plane, but the format wants it
_PARAMS = 7
_LARGEST_E7 = 2**31 - 1


def write_plan(mission: Mission, path: Path, *, cruise_speed_m_s: float) -> None:
    """Write a mission; `read_plan` gives back an equal one.

    Args:
        mission: home first; home is written as a position, so it must be a plain NAV_WAYPOINT in frame 0.
        path: the file.
        cruise_speed_m_s: what QGroundControl reckons flight times with.

    Raises:
        InputError: the file cannot be written or the format cannot hold the mission.
    """
    home = mission.home
    if home != _home_item(home.lat_e7, home.lon_e7, home.alt_m):
        raise InputError(f"{path}: item 0: home must be a NAV_WAYPOINT in frame 0 without parameters")
    plan = {
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
        "geoFence": {"version": 2, "circles": [], "polygons": []},
        "rallyPoints": {"version": 2, "points": []},
    }
    try:
        text = json.dumps(plan, indent=4, allow_nan=False)
    except ValueError as error:
        raise InputError(f"{path}: an infinite or undefined position or speed cannot be written as JSON") from error
    write_text(path, text + "\n")


def read_plan(path: Path) -> Mission:
    """Read the mission of a plan, its planned home position as item 0.

    Raises:
        InputError: what cannot be read, by its place in the JSON; complex items, fences and rally points are refused.
    """
    try:
        plan = json.loads(read_text(path))
    except json.JSONDecodeError as error:
        raise InputError(f"{path}: line {error.lineno}: not JSON: {error.msg}; export the plan again") from error
    reader = _Reader(path)
    root = reader.table(plan, "the file")
    if root.get("fileType") != "Plan":
        raise InputError(f"{path}: fileType: must be 'Plan', got {root.get('fileType')!r}")
    reader.nothing_in(root, "geoFence", ("circles", "polygons"))
    reader.nothing_in(root, "rallyPoints", ("points",))
    mission = reader.table(root.get("mission"), "mission")
    home = reader.numbers(mission.get("plannedHomePosition"), "mission.plannedHomePosition", 3)
    lat_e7, lon_e7 = (reader.e7(home[index], f"mission.plannedHomePosition[{index}]") for index in (0, 1))
    items = [_home_item(lat_e7, lon_e7, home[2])]
    for index, entry in enumerate(reader.array(mission.get("items"), "mission.items")):
        items.append(_read_item(reader, entry, f"mission.items[{index}]"))
    return Mission(tuple(items))


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


def _read_item(reader: "_Reader", entry: Any, key: str) -> MissionItem:
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


class _Reader:
    """Checked access to parsed JSON; errors name the file and the place in it."""

    def __init__(self, path: Path) -> None:
        self._path = path

    def error(self, key: str, reason: str) -> InputError:
        return InputError(f"{self._path}: {key}: {reason}")

    def table(self, value: Any, key: str) -> dict[str, Any]:
        if not isinstance(value, dict):
            raise self.error(key, f"must be an object, got {_shown(value)}")
        return value

    def array(self, value: Any, key: str) -> list[Any]:
        if not isinstance(value, list):
            raise self.error(key, f"must be an array, got {_shown(value)}")
        return value

    def whole(self, value: Any, key: str) -> int:
        if not isinstance(value, int) or isinstance(value, bool):
            raise self.error(key, f"must be a whole number, got {_shown(value)}")
        return value

    def numbers(self, value: Any, key: str, count: int) -> list[float]:
        """An array of so many numbers; null is NaN."""
        values = self.array(value, key)
        if len(values) != count:
            raise self.error(key, f"must have {count} numbers, got {len(values)}")
        return [self._number(number, f"{key}[{index}]") for index, number in enumerate(values)]

    def e7(self, degrees: float, key: str) -> int:
        """Degrees in the wire's 1e-7 degrees; 0 for null, which items without a position may have."""
        if math.isnan(degrees):
            return 0
        if not abs(degrees) * 1e7 <= _LARGEST_E7:
            raise self.error(key, f"must be degrees, got {degrees:g}")
        return degrees_to_e7(degrees)

    def nothing_in(self, root: dict[str, Any], section: str, lists: tuple[str, ...]) -> None:
        """Refuse a section that has content, rather than lose it."""
        for name in lists:
            if self.table(root.get(section, {}), section).get(name):
                raise self.error(f"{section}.{name}", "cannot be read yet; remove them from the plan")

    def _number(self, value: Any, key: str) -> float:
        if value is None:
            return math.nan
        if not isinstance(value, (int, float)) or isinstance(value, bool):
            raise self.error(key, f"must be a number or null, got {_shown(value)}")
        return float(value)


def _shown(value: Any) -> str:
    text = json.dumps(value)
    return text if len(text) <= 40 else text[:37] + "..."
