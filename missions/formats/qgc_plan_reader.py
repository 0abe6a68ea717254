"""`.plan` files read, and the `.mission` files of older stations: QGroundControl's JSON in all its versions.

Three generations of items are read: four keys param1 to param4 and a coordinate; four params and a coordinate; seven
params. In all of them the frame says what the altitude is above; AltitudeMode was numbered anew more than once.
"""

import math
from pathlib import Path
from typing import Any, Literal

from missions.autopilot import Autopilot
from missions.commands import LAST_FRAME, LAST_NAV, Command, Frame
from missions.fence import NO_FENCE
from missions.formats.files import read_text
from missions.formats.json_reader import JsonReader, Note, unheard
from missions.formats.json_text import parse_json
from missions.formats.qgc_areas import read_fence_section, read_rally_section
from missions.formats.qgc_jumps import Numbered, renumbered
from missions.formats.qgc_plan import home_item
from missions.mission import Mission, MissionItem
from missions.vehicle_plan import Plan

ComplexItems = Literal["refuse", "skip", "expand"]
"""What is done with a ComplexItem: refused, left out, or replaced by the simple items that the file keeps of it."""

_SIMPLE, _COMPLEX, _OLD_ITEM = "SimpleItem", "ComplexItem", "missionItem"
_PARAMS = ("param1", "param2", "param3", "param4")
_OLDEST, _OLD = ("1.0", 1), 2
_AGREE_M = 0.01
_ROOT_KEYS = frozenset({"fileType", "version", "groundStation", "mission", "geoFence", "rallyPoints"})
_MISSION_KEYS = frozenset(
    {"version", "firmwareType", "vehicleType", "cruiseSpeed", "hoverSpeed", "globalPlanAltitudeMode", "items"}
    | {"plannedHomePosition", "complexItems", "MAV_AUTOPILOT", "groundStation", "fileType"}
)
_ALTITUDE_KEYS = ("AltitudeMode", "Altitude", "AMSLAltAboveTerrain")
_ITEM_KEYS = frozenset(
    {"type", "frame", "command", "params", "autoContinue", "doJumpId", "coordinate", "id", *_PARAMS, *_ALTITUDE_KEYS}
)


def read_plan(
    path: Path, *, home: MissionItem | None = None, complex_items: ComplexItems = "refuse", note: Note = unheard
) -> Plan:
    """Read a plan, the mission's planned home position as item 0.

    Args:
        path: the file.
        home: taken for the file's own.
        complex_items: what to do with them.
        note: takes what was read otherwise than it stands in the file, or left out.

    Raises:
        InputError: what cannot be read, by its place in the JSON.
    """
    reader = JsonReader(path, note)
    root = reader.table(parse_json(read_text(path), path), "the file")
    section, place = _mission_section(reader, root)
    items = _Items(reader, complex_items, place)
    items.read(section)
    if home is None:
        home = _home(reader, section, f"{place}plannedHomePosition")
    jumping = renumbered(items.found, lambda key, reason: reader.error(key, reason))
    fence = root.get("geoFence")
    return Plan(
        Mission((home, *jumping)),
        NO_FENCE if fence is None else read_fence_section(reader, fence),
        () if root.get("rallyPoints") is None else read_rally_section(reader, root["rallyPoints"]),
    )


def autopilot_of(path: Path) -> Autopilot | None:
    """Whose dialect a plan says that it is in; None when it does not say, or says another.

    Raises:
        InputError: as `read_plan`.
    """
    reader = JsonReader(path, unheard)
    section, _ = _mission_section(reader, reader.table(parse_json(read_text(path), path), "the file"))
    number = section.get("firmwareType", section.get("MAV_AUTOPILOT"))
    return next((one for one in Autopilot if one.mav_autopilot == number), None)


def _mission_section(reader: JsonReader, root: dict[str, Any]) -> tuple[dict[str, Any], str]:
    """The section with the items, and what its keys begin with; an old file is all one section."""
    kind = root.get("fileType")
    if kind in (None, "Mission") and "items" in root and "mission" not in root:
        section, place = root, ""
    elif kind == "Plan":
        reader.table(root, "the file", _ROOT_KEYS)
        if (version := root.get("version", 1)) != 1:
            raise reader.error("version", f"must be 1, got {version!r}; save the plan with a station that writes 1")
        section, place = reader.table(root.get("mission"), "mission"), "mission."
    else:
        raise reader.error("fileType", f"must be 'Plan', got {kind!r}")
    reader.table(section, place.rstrip(".") or "the file", _MISSION_KEYS)
    version = section.get("version", _OLD)
    if version not in (*_OLDEST, _OLD) or isinstance(version, bool):
        raise reader.error(f"{place}version", f"must be 1 or 2, got {version!r}")
    return section, place


def _home(reader: JsonReader, section: dict[str, Any], key: str) -> MissionItem:
    """The planned home position: three numbers, or in the oldest files an item."""
    value = section.get("plannedHomePosition")
    if isinstance(value, dict):
        value, key = value.get("coordinate"), f"{key}.coordinate"
    numbers = [math.nan] if value is None else reader.numbers(value, key, 3)
    if any(map(math.isnan, numbers)):
        raise reader.error(key, "there is none; say where home is with --home LAT,LON,ALT")
    latitude, longitude = (reader.position(numbers[index], f"{key}[{index}]") for index in (0, 1))
    return home_item(latitude, longitude, numbers[2])


class _Items:
    """Reads the items of a mission, in order, into `found`."""

    def __init__(self, reader: JsonReader, complex_items: ComplexItems, place: str) -> None:
        self.found: list[Numbered] = []
        self._reader = reader
        self._complex_items = complex_items
        self._place = place

    def read(self, section: dict[str, Any]) -> None:
        """All of a section."""
        reader, key = self._reader, f"{self._place}items"
        aside = reader.array(section.get("complexItems", []), f"{self._place}complexItems")
        for index, entry in enumerate(aside):
            beside = f"{self._place}complexItems[{index}]"
            self._complex(reader.table(entry, beside), beside)
        for index, entry in enumerate(reader.array(section.get("items"), key)):
            self._read(entry, f"{key}[{index}]")

    def _read(self, entry: Any, key: str) -> None:
        item = self._reader.table(entry, key)
        kind = item.get("type")
        if kind == _COMPLEX:
            self._complex(item, key)
        elif kind in (_SIMPLE, _OLD_ITEM):
            self.found.append(self._simple(item, key))
        else:
            raise self._reader.error(key + ".type", f"must be {_SIMPLE!r}, got {kind!r}")

    def _complex(self, item: dict[str, Any], key: str) -> None:
        name = item.get("complexItemType", "unnamed")
        if self._complex_items == "refuse":
            raise self._reader.error(
                key,
                f"ComplexItem {name!r} cannot be read; replace it by simple items, or say --complex skip to leave it "
                "out or --complex expand to take the items that the file keeps of a survey",
            )
        if self._complex_items == "skip":
            self._reader.note(key, f"ComplexItem {name!r} was left out")
            return
        transects = item.get("TransectStyleComplexItem")
        items = transects.get("Items") if isinstance(transects, dict) else None
        if not isinstance(items, list):
            raise self._reader.error(
                key, f"ComplexItem {name!r}: the file keeps no simple items of it; --complex skip leaves it out"
            )
        inside = f"{key}.TransectStyleComplexItem.Items"
        for index, entry in enumerate(items):
            self._read(entry, f"{inside}[{index}]")
        self._reader.note(key, f"ComplexItem {name!r} became {len(items)} simple items")

    def _simple(self, item: dict[str, Any], key: str) -> Numbered:
        reader = self._reader
        reader.table(item, key, _ITEM_KEYS)
        command = reader.whole(item.get("command"), key + ".command", 0xFFFF)
        frame = reader.whole(item.get("frame"), key + ".frame", LAST_FRAME)
        params = self._params(item, key)
        params[6] = self._altitude_m(item, frame, params[6], key)
        if command == Command.NAV_TAKEOFF and frame == Frame.MISSION and any(params[4:6]):
            reader.note(key, "a take-off in frame 2, which has no position, was read in frame 3 (above home)")
            frame = int(Frame.GLOBAL_RELATIVE_ALT)
        if math.isnan(params[4]) != math.isnan(params[5]):
            raise reader.error(key, "has a latitude or a longitude but not both")
        if math.isnan(params[4]) and frame != Frame.MISSION and command <= LAST_NAV:
            reader.note(key, "has no position, which means where the vehicle is then")
        goes_on = item.get("autoContinue", True)
        if not isinstance(goes_on, bool):
            raise reader.error(key + ".autoContinue", f"must be true or false, got {goes_on!r}")
        jump_id = item.get("doJumpId", item.get("id"))
        read = MissionItem(
            command=command,
            frame=frame,
            param1=params[0],
            param2=params[1],
            param3=params[2],
            param4=params[3],
            lat_e7=reader.position(params[4], key + ".params[4]", frame),
            lon_e7=reader.position(params[5], key + ".params[5]", frame),
            alt_m=params[6],
            autocontinue=goes_on,
        )
        return Numbered(read, None if jump_id is None else reader.whole(jump_id, key + ".doJumpId"), key)

    def _params(self, item: dict[str, Any], key: str) -> list[float]:
        """All seven, whatever the age of the item."""
        reader = self._reader
        if "params" in item and any(name in item for name in _PARAMS):
            raise reader.error(key, "has both params and param1 to param4; leave one of them")
        if "params" not in item and any(name in item for name in _PARAMS):
            params = [reader.number(item.get(name), f"{key}.{name}") for name in _PARAMS]
            if missing := [name for name in _PARAMS if name not in item]:
                raise reader.error(f"{key}.{missing[0]}", "is missing")
        else:
            params = reader.numbers(item.get("params"), key + ".params", 4 if "coordinate" in item else 7)
        if "coordinate" in item or len(params) < 7:
            params += reader.numbers(item.get("coordinate"), key + ".coordinate", 3)
        return params

    def _altitude_m(self, item: dict[str, Any], frame: int, last_param: float, key: str) -> float:
        """The altitude that is flown: the last of params, or what the station shows where that is left open."""
        reader = self._reader
        shown, above_sea = (reader.number(item.get(name), f"{key}.{name}") for name in _ALTITUDE_KEYS[1:])
        reader.number(item.get("AltitudeMode"), f"{key}.AltitudeMode")
        relative = frame not in (Frame.GLOBAL, Frame.GLOBAL_INT)
        if not math.isnan(last_param):
            if relative and frame != Frame.MISSION and abs(shown - last_param) > _AGREE_M:
                raise reader.error(
                    f"{key}.Altitude", f"is {shown:g}, but params[6], which is flown, {last_param:g}; make them equal"
                )
            return last_param
        if math.isnan(shown):
            return last_param
        if not relative and math.isnan(above_sea):
            raise reader.error(
                f"{key}.params[6]",
                f"is not there, and Altitude {shown:g} may be above sea or above ground; write the altitude above sea",
            )
        altitude = shown if relative else above_sea
        taken = _ALTITUDE_KEYS[1 if relative else 2]
        reader.note(key, f"params[6] is not there; {taken}, {altitude:g} m, was taken")
        return altitude
