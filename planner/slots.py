"""Paths of a slot formation: the route's polyline, offset sideways and mitred (MODEL, section 6, Slot formations)."""

import math

import numpy as np
import numpy.typing as npt

from missions.errors import InputError
from missions.reference import fillet
from missions.reference.reference import fillet_radius_m
from missions.scenario import Scenario, VehicleModel
from planner.schedule import Schedule, timed_schedule

FloatArray = npt.NDArray[np.float64]


def slot_path_m(scenario: Scenario, vehicle: VehicleModel) -> FloatArray:
    """(m, 3) corners of a slot's path: from beside the route's first point to beside its last."""
    assert scenario.route is not None
    assert vehicle.slot is not None
    route = np.array(scenario.route.points)
    legs = np.diff(route[:, :2], axis=0)
    headings = np.arctan2(legs[:, 1], legs[:, 0])
    turns = (np.diff(headings) + math.pi) % (2 * math.pi) - math.pi
    middle = headings[:-1] + turns / 2
    mitre = vehicle.slot.left_m / np.cos(turns / 2)
    path = route.copy()
    path[1:-1, 0] -= mitre * np.sin(middle)
    path[1:-1, 1] += mitre * np.cos(middle)
    path[0], path[-1] = scenario.origin_m(vehicle), scenario.target_m(vehicle)
    return path


def slot_schedule(scenario: Scenario, vehicle: VehicleModel, path_m: FloatArray) -> Schedule:
    """The schedule of a slot: each corner as long after the route as the slot lies behind it, start and end with it.

    Raises:
        InputError: the slot lies so far ahead or behind that it would pass a corner before its start or after its end.
    """
    assert scenario.route is not None
    assert vehicle.slot is not None
    route, speed = np.array(scenario.route.points), scenario.route.ground_speed_m_s
    times = fillet(route[:, :2], fillet_radius_m(speed)).corner_s_m / speed
    times[1:-1] += vehicle.slot.behind_m / speed
    if np.any(np.diff(times) <= 0.0):
        raise InputError(
            f"{vehicle.name}: its slot lies further ahead or behind than the route's first or last leg is long"
        )
    return timed_schedule(path_m, times, scenario.wind.forecast_m_s)
