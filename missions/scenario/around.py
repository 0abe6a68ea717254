"""A scenario made around missions that there are: as TOML text, for `skein plan` and for checking them."""

import math
import re
from collections.abc import Sequence
from dataclasses import dataclass

from missions.commands import Command
from missions.errors import InputError
from missions.frame import LocalFrame
from missions.mission import Mission
from missions.reference.reference import FARTHEST_M, place_m, position_m
from missions.scenario.aircraft import AirframeModel
from missions.scenario.load import load_scenario
from missions.scenario.model import LimitsModel

Point = tuple[float, float, float]

PLACES = frozenset(
    {Command.NAV_WAYPOINT, Command.NAV_LOITER_UNLIM, Command.NAV_LOITER_TURNS, Command.NAV_LOITER_TIME}
    | {Command.NAV_LOITER_TO_ALT, Command.NAV_LAND}
)
DEFAULT_AIRFRAME = "vee"
"""The shipped scenario whose airframe stands in."""
MARGIN_M, HEADROOM_M, DEPTH_M = 3000.0, 300.0, 100.0
"""Of the area beside, above and below all places: room for turns, circles and ways around."""
SEPARATION_M, CLEARANCE_M = 75.0, 60.0
_SHIFT = 1.1


@dataclass(frozen=True)
class Named:
    """A mission and what to call its vehicle."""

    name: str
    mission: Mission


def scenario_around(
    missions: Sequence[Named], name: str, airframe: AirframeModel | None = None, terrain: str | None = None
) -> str:
    """The TOML text of a scenario: a vehicle a mission, from its home to the last place far enough from it.

    The local frame's origin is the first mission's home, its z = 0 that home's altitude. Ground is level there unless a
    raster is named. Vehicles that would start or arrive on top of each other are set side by side.

    Args:
        missions: at least one.
        name: of the scenario.
        airframe: of all; that of `DEFAULT_AIRFRAME` unless given.
        terrain: an elevation file, as `terrain.raster` takes it.

    Raises:
        InputError: a mission has no place far enough from home, or one too far from the first home.
    """
    home = missions[0].mission.home
    frame = LocalFrame(home.lat_deg, home.lon_deg, home.alt_m)
    leg_min_m = LimitsModel.model_fields["leg_min_m"].default
    origins: list[Point] = []
    targets: list[Point] = []
    everywhere: list[Point] = []
    for one in missions:
        try:
            places = places_m(one.mission, frame)
        except InputError as error:
            raise InputError(f"{one.name}: {error}") from None
        away = [place for place in places[1:] if math.dist(place[:2], places[0][:2]) >= leg_min_m]
        if not away:
            raise InputError(f"{one.name}: no waypoint at least {leg_min_m:g} m from home, so there is no way to plan")
        origins.append(_beside(places[0], origins))
        targets.append(_beside(away[-1], targets))
        everywhere += places
    everywhere += origins + targets
    x, y, z = zip(*everywhere, strict=True)
    top = _up(max(z) + HEADROOM_M)
    lowest_target = min(target[2] for target in targets)
    if terrain is None and lowest_target <= 0.0:
        raise InputError(f"{name}: a target is no higher than home; name the ground with --terrain FILE")
    clearance_m = CLEARANCE_M if terrain is not None else min(CLEARANCE_M, math.floor(lowest_target))
    lines = [
        f"# Made from {len(missions)} mission files: a way is planned anew from each home to the last place.",
        "# Vehicles that share a place with another start or arrive beside it.",
        f'name = "{tidy(name)}"',
        "seed = 1",
        "",
        "[origin]",
        *(f"{key} = {value!r}" for key, value in (("lat_deg", frame.lat_deg), ("lon_deg", frame.lon_deg))),
        f"alt_m = {frame.alt_m!r}",
        "",
        "[area]",
        f"x_m = [{_down(min(x) - MARGIN_M)}, {_up(max(x) + MARGIN_M)}]",
        f"y_m = [{_down(min(y) - MARGIN_M)}, {_up(max(y) + MARGIN_M)}]",
        f"z_m = [{_down(min(0.0, *z) - DEPTH_M)}, {top}]",
        "",
    ]
    if terrain is None:
        lines += [
            "# The ground is not known: level at home. Name an elevation file here: raster = ...",
            "[terrain]",
            "",
        ]
    else:
        lines += ["[terrain]", f"raster = {_text(terrain)}", ""]
    for sysid, (one, origin, target) in enumerate(zip(missions, origins, targets, strict=True), start=1):
        lines += ["[[vehicles]]", f'name = "{one.name}"', f"sysid = {sysid}"]
        lines += [f"origin = {_point(origin)}", f"target = {_point(target)}", ""]
    model = airframe or load_scenario(DEFAULT_AIRFRAME).airframe
    lines += ["[airframe]"]
    lines += [f"{key} = {_text(value) if isinstance(value, str) else repr(value)}" for key, value in model]
    lines += ["", "[limits]", f"altitude_max_m = {top}", f"separation_m = {SEPARATION_M!r}"]
    lines += [f"clearance_m = {float(clearance_m)!r}", ""]
    return "\n".join(lines)


def tidy(name: str) -> str:
    """A name that scenarios and vehicles may have."""
    return re.sub(r"[^\w-]+", "_", name).strip("_") or "imported"


def places_m(mission: Mission, frame: LocalFrame) -> list[Point]:
    """Home, and every place of a mission in order. Raises InputError when one is too far from the frame's origin."""
    home = mission.home
    places = [position_m(home, home, frame)]
    if not math.hypot(*places[0][:2]) < FARTHEST_M:
        raise InputError(f"home: more than {FARTHEST_M / 1000:g} km from the first file's")
    for seq, item in enumerate(mission.items[1:], start=1):
        if item.command in PLACES:
            places.append(place_m(seq, item, home, frame, places[-1]))
    return places


def _beside(place: Point, taken: Sequence[Point]) -> Point:
    """A place, moved north until it is apart from all that are taken."""
    x, y, z = place
    while any(math.dist((x, y, z), other) < SEPARATION_M for other in taken):
        y += _SHIFT * SEPARATION_M
    return x, y, z


def _up(value: float) -> float:
    return float(math.ceil(value / 10.0) * 10)


def _down(value: float) -> float:
    return float(math.floor(value / 10.0) * 10)


def _point(point: Point) -> str:
    return f"[{', '.join(repr(round(value, 2)) for value in point)}]"


def _text(value: str) -> str:
    """A TOML basic string."""
    return '"' + value.replace("\\", "\\\\").replace('"', '\\"') + '"'
