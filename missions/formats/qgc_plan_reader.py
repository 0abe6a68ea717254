"""`.plan` files read."""

import json
from pathlib import Path
from typing import Any

from missions.errors import InputError
from missions.formats.files import read_text
from missions.formats.json_reader import JsonReader
from missions.formats.qgc_areas import read_fence_section, read_rally_section
from missions.formats.qgc_plan import home_item
from missions.mission import Mission, MissionItem
from missions.vehicle_plan import Plan

_PARAMS = 7


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
    items = [home_item(lat_e7, lon_e7, home[2])]
    for index, entry in enumerate(reader.array(mission.get("items"), "mission.items")):
        items.append(_read_item(reader, entry, f"mission.items[{index}]"))
    fence = read_fence_section(reader, root.get("geoFence", {}))
    return Plan(Mission(tuple(items)), fence, read_rally_section(reader, root.get("rallyPoints", {})))


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
