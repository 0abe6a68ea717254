"""The place that a command names: by coordinates, or where the vehicle is."""

import math

from missions.commands import Frame
from sitl.services.commands.request import UNCHANGED_E7, Answer, Request, denied
from sitl.services.stream_messages.view import View

_ABOVE_SEA = (Frame.GLOBAL, Frame.GLOBAL_INT)
_ABOVE_HOME = (Frame.GLOBAL_RELATIVE_ALT, Frame.GLOBAL_RELATIVE_ALT_INT)
_HERE = ((0, 0), (UNCHANGED_E7, UNCHANGED_E7))
_LARGEST_ALTITUDE_M = 83_000.0
"""ArduPilot's."""


def place_of(request: Request, view: View) -> tuple[int, int, float] | Answer:
    """(lat_e7, lon_e7, metres AMSL) of a command's params 5 to 7, or why there is no such place.

    Latitude and longitude are the vehicle's own where both are 0 or both unchanged; so is an altitude of NaN.
    """
    if request.frame not in _ABOVE_SEA + _ABOVE_HOME:
        return denied(f"Frame {request.frame} has no use here: send 0, 3, 5 or 6")
    lat_e7, lon_e7 = view.lat_lon_e7
    if (request.lat_e7, request.lon_e7) not in _HERE:
        lat_e7, lon_e7 = request.lat_e7, request.lon_e7
    if abs(lat_e7) > 90 * 10**7 or abs(lon_e7) > 180 * 10**7:
        return denied(f"No such place: {lat_e7 / 1e7:g}, {lon_e7 / 1e7:g}")
    if math.isnan(request.z_m):
        return lat_e7, lon_e7, view.altitude_m
    altitude_m = request.z_m + (view.home.alt_m if request.frame in _ABOVE_HOME else 0.0)
    if not abs(altitude_m) <= _LARGEST_ALTITUDE_M:
        return denied(f"No such altitude: {request.z_m:g} m")
    return lat_e7, lon_e7, altitude_m
