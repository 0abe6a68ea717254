"""What a vehicle is told: corners and airspeeds as a mission."""

import math
from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from missions.commands import Command, Frame
from missions.frame import LocalFrame
from missions.mission import Mission, MissionItem
from missions.reference.reference import fillet_radius_m
from planner.loiter import Circle
from planner.schedule import Schedule

FloatArray = npt.NDArray[np.float64]

TAKEOFF_PITCH_DEG = 10.0
TAKEOFF_ALTITUDE_M = 30.0
"""Above the origin; from there on clearance counts (MODEL, section 5)."""
ACCEPTANCE_M = (30.0, 255.0)
"""Least and largest acceptance radius: a few seconds of gusts, and what autopilots store in a byte."""
AIRSPEED_TYPE, THROTTLE_UNCHANGED = 0.0, -1.0
"""DO_CHANGE_SPEED's param1 and param3."""


def write_mission(corners_m: FloatArray, schedule: Schedule, circle: Circle, frame: LocalFrame) -> Mission:
    """Home, take-off, a waypoint a corner with speed changes before the legs, and a loiter at the target.

    Args:
        corners_m: (m, 3) path, origin and target included, local frame.
        schedule: its legs' speeds.
        circle: of the loiter.
        frame: the scenario's local frame. All altitudes are AMSL.
    """

    def item(
        command: Command, at_m: Sequence[float], param1: float = 0.0, param2: float = 0.0, param3: float = 0.0
    ) -> MissionItem:
        x, y, z = at_m
        lat_e7, lon_e7 = frame.to_e7(x, y)
        alt_m = z + frame.alt_m
        return MissionItem(command, Frame.GLOBAL, param1, param2, param3, lat_e7=lat_e7, lon_e7=lon_e7, alt_m=alt_m)

    x, y, z = corners_m[0].tolist()
    items = [
        item(Command.NAV_WAYPOINT, (x, y, z)),
        item(Command.NAV_TAKEOFF, (x, y, z + TAKEOFF_ALTITUDE_M), param1=TAKEOFF_PITCH_DEG),
    ]
    acceptances = acceptance_radii_m(corners_m, fillet_radius_m(float(schedule.ground_m_s.max())))
    told = None
    for corner, airspeed, acceptance in zip(corners_m[1:], schedule.air_m_s.tolist(), acceptances, strict=True):
        change = MissionItem(Command.DO_CHANGE_SPEED, Frame.MISSION, AIRSPEED_TYPE, airspeed, THROTTLE_UNCHANGED)
        if change != told:
            items.append(change)
            told = change
        items.append(item(Command.NAV_WAYPOINT, corner.tolist(), param2=acceptance))
    items.append(item(Command.NAV_LOITER_UNLIM, (circle.x_m, circle.y_m, circle.z_m), param3=circle.radius_m))
    return Mission(tuple(items))


def acceptance_radii_m(corners_m: FloatArray, fillet_radius: float) -> list[float]:
    """For each corner after the first: how far before it its fillet begins, within `ACCEPTANCE_M`."""
    legs = np.diff(corners_m[:, :2], axis=0)
    headings = np.arctan2(legs[:, 1], legs[:, 0])
    turns = np.abs((np.diff(headings) + math.pi) % (2 * math.pi) - math.pi)
    tangents = fillet_radius * np.tan(np.append(turns, 0.0) / 2)
    radii: list[float] = np.clip(np.round(tangents), *ACCEPTANCE_M).tolist()
    return radii
