"""`.waypoints` files read."""

import math
from pathlib import Path

from missions.errors import InputError
from missions.formats.files import read_text
from missions.formats.waypoints import HEADER
from missions.mission import Mission, MissionItem, degrees_to_e7

_COLUMNS = (
    *("index", "current", "frame", "command", "param1", "param2", "param3", "param4"),
    *("latitude", "longitude", "altitude", "autocontinue"),
)
_WHOLE = frozenset({"index", "current", "frame", "command", "autocontinue"})
_LARGEST_E7 = 2**31 - 1


def read_waypoints(path: Path) -> Mission:
    """Read a mission whose row 0 is home. Raises InputError naming the line and the column."""
    lines = read_text(path).splitlines()
    header = lines[0].strip() if lines else ""
    if header != HEADER:
        raise InputError(
            f"{path}: line 1: must be {HEADER!r}, got {header!r}; export it as {HEADER}, with home as row 0"
        )
    rows = [(number, line) for number, line in enumerate(lines[1:], 2) if line.strip()]
    if not rows:
        raise InputError(f"{path}: no row 0; add the home position")
    return Mission(tuple(_read_row(line, seq, f"{path}: line {number}") for seq, (number, line) in enumerate(rows)))


def _read_row(line: str, seq: int, where: str) -> MissionItem:
    texts = line.rstrip("\r\n").split("\t")
    if len(texts) != len(_COLUMNS):
        raise InputError(f"{where}: must have {len(_COLUMNS)} tab-separated columns, got {len(texts)}")
    values = {name: _number(name, text.strip(), where) for name, text in zip(_COLUMNS, texts, strict=True)}
    if values["index"] != seq:
        raise InputError(f"{where}: index: must be {seq}, got {values['index']:g}; number the rows from 0")
    return MissionItem(
        command=int(values["command"]),
        frame=int(values["frame"]),
        param1=values["param1"],
        param2=values["param2"],
        param3=values["param3"],
        param4=values["param4"],
        lat_e7=_e7("latitude", values, where),
        lon_e7=_e7("longitude", values, where),
        alt_m=values["altitude"],
        autocontinue=bool(values["autocontinue"]),
    )


def _number(name: str, text: str, where: str) -> float:
    try:
        return float(int(text)) if name in _WHOLE else float(text)
    except ValueError:
        kind = "a whole number" if name in _WHOLE else "a number"
        raise InputError(f"{where}: {name}: must be {kind}, got {text!r}") from None


def _e7(name: str, values: dict[str, float], where: str) -> int:
    degrees = values[name]
    if not (math.isfinite(degrees) and abs(degrees_to_e7(degrees)) <= _LARGEST_E7):
        raise InputError(f"{where}: {name}: must be degrees, got {degrees:g}")
    return degrees_to_e7(degrees)
