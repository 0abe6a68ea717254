"""`.waypoints` files written: QGC WPL 110, read by QGroundControl, Mission Planner, MAVProxy and pymavlink."""

import math
from pathlib import Path

from missions.formats.files import write_text
from missions.mission import Mission, as_float32

HEADER = "QGC WPL 110"


def write_waypoints(mission: Mission, path: Path) -> None:
    """Write a mission, home as row 0; `read_waypoints` gives back an equal one. Raises InputError."""
    rows = [HEADER]
    for seq, item in enumerate(mission):
        columns = [
            *(str(number) for number in (seq, int(seq == 0), item.frame, item.command)),
            *(_float32_text(value) for value in item.params),
            *(f"{item.lat_deg:.8f}", f"{item.lon_deg:.8f}"),
            _float32_text(item.alt_m),
            str(int(item.autocontinue)),
        ]
        rows.append("\t".join(columns))
    write_text(path, "\n".join(rows) + "\n")


def _float32_text(value: float) -> str:
    """Eight decimals where they hold the float32 exactly, else as many digits as it takes."""
    text = f"{value:.8f}"
    return text if math.isnan(value) or as_float32(float(text)) == value else repr(value)
