"""What missions are checked against: a scenario, or one made for the purpose where nobody names one."""

from collections.abc import Sequence
from pathlib import Path

from pydantic import ValidationError

from missions.errors import InputError
from missions.frame import LocalFrame
from missions.mission import Mission
from missions.reference.reference import FARTHEST_M
from missions.scenario import Scenario, load_scenario
from missions.scenario.around import DEFAULT_AIRFRAME, places_m
from missions.scenario.model import Files

MARGIN_M = 1000.0
"""Of the area around all places, which the elevation file must cover."""
HIGHEST_M = 100_000.0
SEPARATION_M, CLEARANCE_M = 75.0, 60.0


def setting_for(missions: Sequence[Mission], airframe_of: str | None = None, terrain: Path | None = None) -> Scenario:
    """A scenario around missions, with its origin at the first one's home and level ground there, or a raster.

    Its limits on legs and turns are so wide that they mean nothing; those of a real scenario come from its file.

    Args:
        missions: at least one.
        airframe_of: the scenario, by name or file, whose airframe is taken.
        terrain: an elevation file.

    Raises:
        InputError: a home is too far from the first one's, or a file cannot be used.
    """
    if terrain is not None and not terrain.is_file():
        raise InputError(f"{terrain}: no such file")
    home = missions[0].home
    frame = LocalFrame(home.lat_deg, home.lon_deg, home.alt_m)
    places = [place for mission in missions for place in places_m(mission, frame)]
    x, y, _ = zip(*places, strict=True)
    airframe = load_scenario(airframe_of or DEFAULT_AIRFRAME).airframe
    values = {
        "name": "check",
        "origin": {"lat_deg": frame.lat_deg, "lon_deg": frame.lon_deg, "alt_m": frame.alt_m},
        "area": {
            "x_m": (min(x) - MARGIN_M, max(x) + MARGIN_M),
            "y_m": (min(y) - MARGIN_M, max(y) + MARGIN_M),
            "z_m": (-HIGHEST_M, HIGHEST_M),
        },
        "terrain": {} if terrain is None else {"raster": str(terrain.resolve())},
        "vehicles": [{"name": "one", "sysid": 1, "origin": (0.0, 0.0, 0.0), "target": (1000.0, 0.0, 100.0)}],
        "airframe": airframe.model_dump(),
        "limits": {
            "altitude_max_m": HIGHEST_M,
            "separation_m": SEPARATION_M,
            "clearance_m": CLEARANCE_M,
            "leg_min_m": 1.0,
            "leg_max_m": 2.0 * FARTHEST_M,
            "turn_max_deg": 179.0,
        },
    }
    try:
        return Scenario.model_validate(values, context=Files(folder=Path(), raster=None))
    except ValidationError as error:
        first = error.errors()[0]
        where = ".".join(map(str, first["loc"])) or "--terrain"
        raise InputError(f"{where}: {first['msg'].removeprefix('Value error, ')}") from None
