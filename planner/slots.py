"""Paths of a slot formation: the route's polyline, offset sideways and mitred (MODEL, section 6, Slot formations)."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from missions.errors import InputError
from missions.reference import fillet
from missions.reference.reference import fillet_radius_m
from missions.scenario import Scenario, VehicleModel
from planner.schedule import Schedule, timed_schedule

FloatArray = npt.NDArray[np.float64]
IntArray = npt.NDArray[np.int64]

AS_IN_PATTERN, STAGGERED, SINGLE_FILE = 0, 1, 2
"""How slots pass a corner: as far behind the route as their pattern has them; further where the narrowed formation
would bring them too near to each other; or all one after the other."""
APART = 1.25
"""Of the least separation: how far from each other slots pass a corner where they are staggered."""


@dataclass(frozen=True)
class SlotFit:
    """How a formation goes along its route.

    Attributes:
        route_m: (m, 3) corners of the route.
        scale: (m,) what sideways offsets are multiplied by at each corner, at most 1; between corners it changes
            evenly. 1 at both ends.
        stagger: (m,) how slots pass each corner: `AS_IN_PATTERN`, `STAGGERED` or `SINGLE_FILE`.
    """

    route_m: FloatArray
    scale: FloatArray
    stagger: IntArray


def full_width(route_m: FloatArray) -> SlotFit:
    """The formation as its slots have it, all the way."""
    return SlotFit(route_m, np.ones(len(route_m)), np.full(len(route_m), AS_IN_PATTERN))


def route_of(scenario: Scenario) -> FloatArray:
    """(m, 3) corners of the scenario's route."""
    assert scenario.route is not None
    return np.array(scenario.route.points)


def slot_path_m(scenario: Scenario, vehicle: VehicleModel, fit: SlotFit | None = None) -> FloatArray:
    """(m, 3) corners of a slot's path: from beside the route's first point to beside its last."""
    assert vehicle.slot is not None
    fit = fit or full_width(route_of(scenario))
    legs = np.diff(fit.route_m[:, :2], axis=0)
    headings = np.arctan2(legs[:, 1], legs[:, 0])
    turns = (np.diff(headings) + math.pi) % (2 * math.pi) - math.pi
    middle = headings[:-1] + turns / 2
    mitre = fit.scale[1:-1] * vehicle.slot.left_m / np.cos(turns / 2)
    path = fit.route_m.copy()
    path[1:-1, 0] -= mitre * np.sin(middle)
    path[1:-1, 1] += mitre * np.cos(middle)
    path[0], path[-1] = scenario.origin_m(vehicle), scenario.target_m(vehicle)
    return path


def slot_schedule(
    scenario: Scenario, vehicle: VehicleModel, path_m: FloatArray, fit: SlotFit | None = None
) -> Schedule:
    """The schedule of a slot: each corner as long after the route as the slot lies behind it, start and end with it.

    Raises:
        InputError: the slot lies so far ahead or behind that it would pass a corner before its start or after its end.
    """
    assert scenario.route is not None
    assert vehicle.slot is not None
    fit = fit or full_width(route_of(scenario))
    speed = scenario.route.ground_speed_m_s
    times = fillet(fit.route_m[:, :2], fillet_radius_m(speed)).corner_s_m / speed
    for corner in range(1, len(times) - 1):
        times[corner] += _behind_m(scenario, vehicle, float(fit.scale[corner]), int(fit.stagger[corner])) / speed
    if np.any(np.diff(times) <= 0.0):
        raise InputError(
            f"{vehicle.name}: its slot lies further ahead or behind than the route's first or last leg is long"
        )
    return timed_schedule(path_m, times, scenario.wind.forecast_m_s)


def _behind_m(scenario: Scenario, vehicle: VehicleModel, scale: float, stagger: int) -> float:
    """How far behind the route a slot passes a corner."""
    assert vehicle.slot is not None
    if stagger == AS_IN_PATTERN:
        return vehicle.slot.behind_m
    apart = APART * scenario.limits.separation_m
    return staggered_behind_m(scenario.vehicles, 0.0 if stagger == SINGLE_FILE else scale, apart)[vehicle.sysid]


def staggered_behind_m(vehicles: Sequence[VehicleModel], scale: float, apart_m: float) -> dict[int, float]:
    """How far behind the route the slots, by sysid, pass a corner at which sideways offsets are scaled.

    In order of the slots, the middle ones first: each where its pattern has it, or as much further behind as keeps it
    `apart_m` from all before it.
    """
    slots = sorted(
        (vehicle.slot.behind_m, abs(vehicle.slot.left_m), vehicle.slot.left_m, vehicle.sysid)
        for vehicle in vehicles
        if vehicle.slot
    )
    placed: list[tuple[float, float]] = []
    behind = {}
    for wanted_m, _, left_m, sysid in slots:
        taken = []
        for other_behind_m, other_left_m in placed:
            aside = scale * (left_m - other_left_m)
            reach = math.sqrt(max(0.0, apart_m**2 - aside**2))
            taken.append((other_behind_m - reach, other_behind_m + reach))
        behind_m = wanted_m
        for start, end in sorted(taken):
            if start < behind_m < end:
                behind_m = end
        placed.append((behind_m, left_m))
        behind[sysid] = behind_m
    return behind
