"""What a vehicle forbids of a plan: too many items, and what its parameters say, by ArduPlane's names of old and new
firmware, and PX4's.
"""

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from gcs.check.flight import Flight
from gcs.check.problem import Problem
from missions.autopilot import Autopilot
from missions.commands import Command
from missions.dialect import wire_items
from missions.fence import fence_items
from missions.plan_type import PlanType
from missions.reference.reference import position_m
from missions.scenario import Scenario
from missions.vehicle_plan import Plan
from sitl.fence_watch import ALT_MAX, ALT_MIN, CIRCLE, POLYGONS

SLOWEST = ("AIRSPEED_MIN", "ARSPD_FBW_MIN", "FW_AIRSPD_MIN")
FASTEST = ("AIRSPEED_MAX", "ARSPD_FBW_MAX", "FW_AIRSPD_MAX")
STEP_M = 5.0
AIRSPEED_TYPE = 0.0


@dataclass(frozen=True)
class VehicleLimits:
    """What a vehicle has told of itself.

    Attributes:
        parameters: by name.
        capacities: how many items it takes of each plan; without those of which it does not say so.
        autopilot: whose form its missions have.
    """

    parameters: Mapping[str, float]
    capacities: Mapping[PlanType, int] = field(default_factory=dict)
    autopilot: Autopilot = Autopilot.ardupilot


def forbidden(
    file: Path, plan: Plan, flight: Flight | None, vehicle: VehicleLimits, scenario: Scenario
) -> Iterator[Problem]:
    """What a vehicle forbids; parameters that it has not got forbid nothing.

    Args:
        file: that the plan is of.
        plan, flight: what is to be flown; no flight where there is none on paper.
        vehicle: what it has told.
        scenario: with the local frame.
    """
    parameters = vehicle.parameters
    yield from _too_many(str(file), plan, vehicle)
    yield from _speeds(str(file), plan, parameters)
    enabled = parameters.get("FENCE_ENABLE", 0.0) != 0.0
    kinds = int(parameters.get("FENCE_TYPE", 0.0))
    if plan.fence.areas and vehicle.autopilot is Autopilot.px4:
        if parameters.get("GF_ACTION") == 0.0:
            yield Problem(str(file), None, "the fence would not be heeded", "GF_ACTION 0", "1 or more")
    elif plan.fence.areas and not (enabled and kinds & POLYGONS):
        said = f"FENCE_ENABLE {parameters.get('FENCE_ENABLE', 0.0):g}, FENCE_TYPE {kinds}"
        yield Problem(str(file), None, "the fence would not be heeded", said, f"1 and the bit {POLYGONS}")
    if flight is not None:
        yield from _acceptance(str(file), flight, parameters)
        yield from _rally(str(file), plan, flight, parameters, scenario)
        if enabled:
            yield from _set_fences(str(file), plan, flight, parameters, kinds, scenario)


def _too_many(file: str, plan: Plan, vehicle: VehicleLimits) -> Iterator[Problem]:
    """Plans for which the vehicle has no room."""
    counts = {
        PlanType.MISSION: len(wire_items(plan.mission, vehicle.autopilot)),
        PlanType.FENCE: len(fence_items(plan.fence)),
        PlanType.RALLY: len(plan.rally),
    }
    for plan_type, limit in vehicle.capacities.items():
        if (count := counts[plan_type]) > limit:
            what = f"more {plan_type.name.lower()} items than the vehicle takes"
            yield Problem(file, None, what, f"{count}", f"{limit}")


def _speeds(file: str, plan: Plan, parameters: Mapping[str, float]) -> Iterator[Problem]:
    """Airspeeds that the vehicle would ignore."""
    for names, sign in ((SLOWEST, 1.0), (FASTEST, -1.0)):
        name = next((name for name in names if name in parameters), None)
        for seq, item in enumerate(plan.mission):
            asked = item.command == Command.DO_CHANGE_SPEED and item.param1 == AIRSPEED_TYPE and item.param2 > 0.0
            if name is not None and asked and sign * (item.param2 - parameters[name]) < 0.0:
                limit = f"{name} {parameters[name]:g}"
                yield Problem(file, seq, "airspeed that the vehicle ignores", f"{item.param2:g} m/s", limit)


def _acceptance(file: str, flight: Flight, parameters: Mapping[str, float]) -> Iterator[Problem]:
    """Legs that are shorter than the radius within which their end counts as reached."""
    radius_m = parameters.get("WP_RADIUS", 0.0)
    for _, path in flight.paths:
        for seq, length_m in zip(path.corner_seq[1:], np.diff(path.path.corner_s_m).tolist(), strict=True):
            if length_m < radius_m:
                yield Problem(
                    file, seq, "leg within the acceptance radius", f"{length_m:.0f} m", f"WP_RADIUS {radius_m:g}"
                )


def _rally(
    file: str, plan: Plan, flight: Flight, parameters: Mapping[str, float], scenario: Scenario
) -> Iterator[Problem]:
    """Where all rally points are farther away than those that count, on samples of the flight."""
    limit_km = parameters.get("RALLY_LIMIT_KM", 0.0)
    if not plan.rally or limit_km <= 0.0:  # 0 is no limit
        return
    s_m = np.arange(0.0, flight.whole.length_m, STEP_M)
    x, y, _ = flight.whole.points(s_m).T
    places = [scenario.frame.from_e7(rally.lat_e7, rally.lon_e7) for rally in plan.rally]
    nearest_km = np.min([np.hypot(x - at[0], y - at[1]) for at in places], axis=0) / 1000.0
    k = int(np.argmax(nearest_km))
    if nearest_km[k] > limit_km:
        item, limit = flight.item_at(float(s_m[k])), f"RALLY_LIMIT_KM {limit_km:g}"
        yield Problem(file, item, "rally point that does not count", f"{nearest_km[k]:.1f} km away", limit)


def _set_fences(
    file: str, plan: Plan, flight: Flight, parameters: Mapping[str, float], kinds: int, scenario: Scenario
) -> Iterator[Problem]:
    """Altitudes and the circle about home that are set as parameters, on samples of the flight."""
    home = position_m(plan.mission.home, plan.mission.home, scenario.frame)
    s_m = np.arange(0.0, flight.whole.length_m, STEP_M)
    x, y, z = flight.whole.points(s_m).T
    above, away = z - home[2], np.hypot(x - home[0], y - home[1])
    least = parameters.get("FENCE_ALT_MIN", -math.inf)
    # The lowest altitude counts once it has been passed, and not on the way to a landing.
    flying = (np.maximum.accumulate(above) >= least) & (s_m < flight.descent_m)
    for bit, name, what, values, sign in (
        (ALT_MAX, "FENCE_ALT_MAX", "height above home", above, 1.0),
        (ALT_MIN, "FENCE_ALT_MIN", "height above home", np.where(flying, above, math.inf), -1.0),
        (CIRCLE, "FENCE_RADIUS", "distance from home", away, 1.0),
    ):
        if kinds & bit and name in parameters:
            k = int(np.argmax(sign * values))
            if sign * (values[k] - parameters[name]) > 0.0:
                item = flight.item_at(float(s_m[k]))
                yield Problem(file, item, what, f"{values[k]:.0f} m", f"{name} {parameters[name]:g}")
