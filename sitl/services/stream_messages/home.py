"""Where a vehicle returns to, and where its local positions are counted from."""

import math

from pymavlink.dialects.v20 import ardupilotmega as mavlink

from missions.mission import degrees_to_e7
from sitl.services.peer import Message
from sitl.services.stream_messages.view import View


def home_position(view: View) -> Message:
    """HOME_POSITION."""
    home = view.home
    x_m, y_m = view.frame.from_e7(home.lat_e7, home.lon_e7)
    down_m = view.frame.alt_m - home.alt_m
    nan = math.nan
    return mavlink.MAVLink_home_position_message(
        home.lat_e7, home.lon_e7, round(home.alt_m * 1000), y_m, x_m, down_m, (1.0, 0.0, 0.0, 0.0), nan, nan, nan
    )


def gps_global_origin(view: View) -> Message:
    """GPS_GLOBAL_ORIGIN: where LOCAL_POSITION_NED is zero."""
    frame = view.frame
    latitude, longitude = degrees_to_e7(frame.lat_deg), degrees_to_e7(frame.lon_deg)
    return mavlink.MAVLink_gps_global_origin_message(latitude, longitude, round(frame.alt_m * 1000))
