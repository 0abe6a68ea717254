"""`.waypoints` files read: QGC WPL 110 and 120, as QGroundControl, Mission Planner, MAVProxy and scripts write them."""

import re
from dataclasses import replace
from pathlib import Path

from missions.commands import LAST_FRAME, Command
from missions.errors import InputError
from missions.formats.files import read_text
from missions.formats.wire import param_on_wire, position_on_wire
from missions.mission import Mission, MissionItem

_COLUMNS = (
    *("index", "current", "frame", "command", "param1", "param2", "param3", "param4"),
    *("latitude", "longitude", "altitude", "autocontinue"),
)
_LARGEST = {"index": 0xFFFF, "current": 1, "frame": LAST_FRAME, "command": 0xFFFF, "autocontinue": 1}
"""Of the columns with whole numbers."""
_HEADER = re.compile(r"QGC\s+WPL\s+(.+)")
_WITH_HOME, _WITHOUT_HOME = "110", "120"
_NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?|[+-]?nan", re.ASCII | re.IGNORECASE)


def read_waypoints(path: Path, *, home: MissionItem | None = None) -> Mission:
    """Read a mission. Row 0 of version 110 is home; version 120 has none.

    White space or commas separate columns; lines that begin with # are comments.

    Args:
        path: the file.
        home: item 0; the file's own unless given.

    Raises:
        InputError: what cannot be read, by line and column.
    """
    lines = read_text(path).splitlines()
    header = lines[0].strip() if lines else ""
    found = _HEADER.fullmatch(header)
    if found is None or found[1] not in (_WITH_HOME, _WITHOUT_HOME):
        raise InputError(
            f"{path}: line 1: must be 'QGC WPL 110', got {header[:40]!r}; export it as QGC WPL 110, with home as row 0"
        )
    rows = [
        (f"{path}: line {number}", line)
        for number, line in enumerate(lines[1:], 2)
        if line.strip() and not line.lstrip().startswith("#")
    ]
    first = 0
    items: list[MissionItem] = []
    for where, line in rows:
        values = _values(line, where)
        if not items and values["index"] == 1:
            first = 1
        if values["index"] != first + len(items):
            raise InputError(
                f"{where}: index: must be {first + len(items)}, got {values['index']:g}; number the rows one by one"
            )
        items.append(_item(values, where))
    if found[1] == _WITH_HOME and first == 0:
        if not items:
            raise InputError(f"{path}: no row 0; add the home position")
        return Mission(tuple(items) if home is None else (home, *items[1:]))
    if home is None:
        what = "QGC WPL 120 has no home" if found[1] == _WITHOUT_HOME else "row 0, home, is missing"
        raise InputError(f"{path}: {what}; say where home is with --home LAT,LON,ALT")
    return Mission((home, *(_after_home(item, first) for item in items)))


def _after_home(item: MissionItem, first: int) -> MissionItem:
    """Jumps count rows from the first one; here home comes before it."""
    return replace(item, param1=item.param1 + 1.0 - first) if item.command == Command.DO_JUMP else item


def _values(line: str, where: str) -> dict[str, float]:
    """The columns of a row; whole numbers where those must be."""
    texts = line.split(",") if line.count(",") == len(_COLUMNS) - 1 else line.split()
    if len(texts) != len(_COLUMNS):
        raise InputError(f"{where}: must have {len(_COLUMNS)} tab-separated columns, got {len(texts)}")
    return {name: _number(name, text.strip(), where) for name, text in zip(_COLUMNS, texts, strict=True)}


def _number(name: str, text: str, where: str) -> float:
    value = float(text) if _NUMBER.fullmatch(text) else None
    largest = _LARGEST.get(name)
    if largest is None:
        if value is None:
            raise InputError(f"{where}: {name}: must be a number, got {text[:40]!r}")
        return value
    if value is None or not value.is_integer():
        raise InputError(f"{where}: {name}: must be a whole number, got {text[:40]!r}")
    if not 0 <= value <= largest:
        raise InputError(f"{where}: {name}: must be 0 to {largest}, got {text[:40]!r}")
    return value


def _item(values: dict[str, float], where: str) -> MissionItem:
    frame = int(values["frame"])
    return MissionItem(
        command=int(values["command"]),
        frame=frame,
        param1=_param("param1", values, where),
        param2=_param("param2", values, where),
        param3=_param("param3", values, where),
        param4=_param("param4", values, where),
        lat_e7=_position("latitude", values, frame, where),
        lon_e7=_position("longitude", values, frame, where),
        alt_m=_param("altitude", values, where),
        autocontinue=bool(values["autocontinue"]),
    )


def _position(name: str, values: dict[str, float], frame: int, where: str) -> int:
    try:
        return position_on_wire(values[name], frame)
    except ValueError as error:
        raise InputError(f"{where}: {name}: {error}") from None


def _param(name: str, values: dict[str, float], where: str) -> float:
    try:
        return param_on_wire(values[name])
    except ValueError as error:
        raise InputError(f"{where}: {name}: {error}") from None
