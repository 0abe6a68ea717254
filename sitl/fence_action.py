"""What a breach of the fence leads to, and where (FENCE_ACTION, FENCE_RET_*)."""

from collections.abc import Sequence
from enum import IntEnum

from missions.frame import LocalFrame
from missions.mission import MissionItem
from missions.reference.reference import position_m
from sitl.fence_watch import ALT_MAX, ALT_MIN, FenceAreas
from sitl.flight import Vector
from sitl.homing import refuge
from sitl.parameters import Parameters


class FenceAction(IntEnum):
    """Values of FENCE_ACTION; where there is no pilot's throttle, 7 is as 6."""

    REPORT = 0
    RTL = 1
    GUIDED = 6
    GUIDED_THROTTLE = 7
    AUTOLAND = 8

    @property
    def words(self) -> str:
        """For the pilot."""
        return {0: "flying on", 1: "RTL", 8: "landing, or RTL"}.get(int(self), "GUIDED to the return point")


def fence_return(
    here_m: Vector,
    areas: FenceAreas | None,
    home: MissionItem,
    rally: Sequence[MissionItem],
    frame: LocalFrame,
    parameters: Parameters,
) -> Vector:
    """Where a breach leads to: the fence's return point, with FENCE_RET_RALLY the rally point, or home.

    The altitude is FENCE_RET_ALT above home; without, half-way between the altitude fences, else RTL_ALTITUDE.
    """
    x, y, z = position_m(home, home, frame)
    if parameters["FENCE_RET_RALLY"] == 1 and rally:
        return refuge(here_m, home, rally, frame, parameters)
    if areas is not None and areas.return_point_m is not None:
        x, y = areas.return_point_m
    kinds = int(parameters["FENCE_TYPE"])
    if parameters["FENCE_RET_ALT"] > 0:
        return x, y, z + parameters["FENCE_RET_ALT"]
    if kinds & ALT_MAX and kinds & ALT_MIN:
        return x, y, z + 0.5 * (parameters["FENCE_ALT_MIN"] + parameters["FENCE_ALT_MAX"])
    above_m = parameters["RTL_ALTITUDE"]
    return x, y, here_m[2] if above_m < 0.0 else z + above_m
