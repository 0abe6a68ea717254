"""Home, where a vehicle returns to: item 0 of every mission."""

from missions.commands import Command, Frame
from missions.frame import LocalFrame
from missions.mission import MissionItem
from sitl.flight import Vector


def home_at(place_m: Vector, frame: LocalFrame) -> MissionItem:
    """The home item of a place in the local frame, metres."""
    x, y, z = place_m
    lat_e7, lon_e7 = frame.to_e7(x, y)
    return MissionItem(Command.NAV_WAYPOINT, Frame.GLOBAL, lat_e7=lat_e7, lon_e7=lon_e7, alt_m=z + frame.alt_m)
