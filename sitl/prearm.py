"""What speaks against arming, as ArduPlane's pre-arm checks put it."""

from missions.environment.terrain import Terrain, ground_height_m
from sitl.fence_watch import FenceWatch
from sitl.flight import Vector
from sitl.modes import Mode
from sitl.parameters import Parameters

BELOW_GROUND_M = 20.0
"""Home may be this far below the terrain model."""
ARMABLE = (Mode.MANUAL, Mode.AUTO, Mode.TAKEOFF)


def reason_not_to_arm(
    mode: Mode,
    *,
    flies: bool,
    parameters: Parameters,
    fence: FenceWatch,
    home_m: Vector,
    here_m: Vector,
    terrain: Terrain,
) -> str | None:
    """The first reason, None when there is none; ARMING_CHECK 0 skips the checks.

    Args:
        flies: whether there is a mission to fly.
        home_m, here_m: of the vehicle.
    """
    if parameters["ARMING_CHECK"] == 0:
        return None
    if mode not in ARMABLE:
        return f"{mode.name} is no mode to arm in: change to MANUAL, AUTO or TAKEOFF"
    if mode == Mode.AUTO and not flies:
        return "AUTO without a mission: upload one"
    slow, fast, cruise = (parameters[f"AIRSPEED_{name}"] for name in ("MIN", "MAX", "CRUISE"))
    if slow >= fast:
        return f"AIRSPEED_MIN {slow:g} is not below AIRSPEED_MAX {fast:g}"
    if not slow <= cruise <= fast:
        return f"AIRSPEED_CRUISE {cruise:g} is not within AIRSPEED_MIN {slow:g} and AIRSPEED_MAX {fast:g}"
    below_m = ground_height_m(home_m[0], home_m[1], terrain) - home_m[2]
    if below_m > BELOW_GROUND_M:
        return f"Home is {below_m:.0f} m below the terrain: set it anew"
    return _fence(parameters, fence, home_m, here_m) if fence.enabled else None


def _fence(parameters: Parameters, fence: FenceWatch, home_m: Vector, here_m: Vector) -> str | None:
    if (missing := fence.missing()) is not None:
        return missing
    if parameters["FENCE_ALT_MIN"] >= parameters["FENCE_ALT_MAX"]:
        return "FENCE_ALT_MIN is not below FENCE_ALT_MAX"
    for name, place in (("Home", home_m), ("Vehicle", here_m)):
        if (crossing := fence.crossing(place, home_m, heed_least=False)) is not None:
            return f"{name} is beyond the fence: {crossing.text}"
    return None
