"""Where a vehicle returns to: home, or the rally point that is nearest (ArduPlane's RTL_* and RALLY_*)."""

import math
from collections.abc import Sequence

from missions.commands import Command
from missions.errors import InputError
from missions.frame import LocalFrame
from missions.mission import MissionItem
from missions.reference.reference import FARTHEST_M, position_m
from sitl.flight import Vector
from sitl.parameters import Parameters


def check_rally(items: Sequence[MissionItem], frame: LocalFrame) -> None:
    """Raises InputError when these are no rally points, or too far away."""
    for seq, item in enumerate(items):
        if item.command != Command.NAV_RALLY_POINT:
            raise InputError(f"rally item {seq}: command {item.command} is no rally point")
        if not math.hypot(*frame.from_e7(item.lat_e7, item.lon_e7)) < FARTHEST_M:
            raise InputError(f"rally item {seq}: more than {FARTHEST_M / 1000:g} km from the scenario's origin")


def refuge(
    here_m: Vector, home: MissionItem, rally: Sequence[MissionItem], frame: LocalFrame, parameters: Parameters
) -> Vector:
    """Home at RTL_ALTITUDE above it (-1: at the present altitude), or the nearest rally point at its own.

    A rally point counts within RALLY_LIMIT_KM (0: any), and with RALLY_INCL_HOME only where home is not nearer.
    """
    x, y, z = position_m(home, home, frame)
    above_m = parameters["RTL_ALTITUDE"]
    at_home = (x, y, here_m[2] if above_m < 0.0 else z + above_m)
    limit_m = 1000.0 * parameters["RALLY_LIMIT_KM"] or math.inf
    points = [position_m(item, home, frame) for item in rally]
    away_m = [math.dist(point[:2], here_m[:2]) for point in points]
    if not points or min(away_m) > limit_m:
        return at_home
    nearest = away_m.index(min(away_m))
    if parameters["RALLY_INCL_HOME"] == 1 and math.dist((x, y), here_m[:2]) < away_m[nearest]:
        return at_home
    return points[nearest]
