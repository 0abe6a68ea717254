"""Where a vehicle is and how it flies: ATTITUDE, positions, VFR_HUD, GPS_RAW_INT, WIND, NAV_CONTROLLER_OUTPUT."""

import math

from pymavlink.dialects.v20 import ardupilotmega as mavlink

from missions.airframe import GRAVITY_M_S2
from sitl.services.peer import Message
from sitl.services.stream_messages.view import View

_GPS_SATELLITES = 12
_GPS_DILUTION = 80  # hundredths


def _centidegrees(angle: float) -> int:
    return round(math.degrees(angle) * 100) % 36000


def _int16(value: float) -> int:
    return max(-32768, min(32767, round(value)))


def _uint16(value: float) -> int:
    return max(0, min(0xFFFF, round(value)))


def attitude(view: View) -> Message:
    """ATTITUDE: wings and nose along the air velocity; the yaw rate is that of a coordinated turn."""
    now = view.snapshot
    roll = -now.bank
    yaw_rate = GRAVITY_M_S2 * math.tan(roll) / now.airspeed_m_s if now.airborne and now.airspeed_m_s > 0 else 0.0
    return mavlink.MAVLink_attitude_message(view.time_boot_ms, roll, now.climb_angle, view.yaw, 0.0, 0.0, yaw_rate)


def global_position(view: View) -> Message:
    """GLOBAL_POSITION_INT."""
    east, north, up = view.snapshot.ground_velocity_m_s
    return mavlink.MAVLink_global_position_int_message(
        view.time_boot_ms,
        *view.lat_lon_e7,
        round(view.altitude_m * 1000),
        round((view.altitude_m - view.home.alt_m) * 1000),
        _int16(north * 100),
        _int16(east * 100),
        _int16(-up * 100),
        _centidegrees(view.yaw),
    )


def local_position(view: View) -> Message:
    """LOCAL_POSITION_NED, from the origin of the local frame (GPS_GLOBAL_ORIGIN), common to a swarm."""
    x_m, y_m, z_m = view.snapshot.position_m
    east, north, up = view.snapshot.ground_velocity_m_s
    return mavlink.MAVLink_local_position_ned_message(view.time_boot_ms, y_m, x_m, -z_m, north, east, -up)


def vfr_hud(view: View) -> Message:
    """VFR_HUD."""
    now = view.snapshot
    return mavlink.MAVLink_vfr_hud_message(
        now.airspeed_m_s,
        view.ground_speed_m_s,
        round(math.degrees(view.yaw)) % 360,
        max(0, min(100, round(now.thrust_fraction * 100))),
        view.altitude_m,
        now.ground_velocity_m_s[2],
    )


def gps_raw(view: View) -> Message:
    """GPS_RAW_INT."""
    east, north, _ = view.snapshot.ground_velocity_m_s
    return mavlink.MAVLink_gps_raw_int_message(
        round(view.snapshot.time_s * 1e6),
        mavlink.GPS_FIX_TYPE_3D_FIX,
        *view.lat_lon_e7,
        round(view.altitude_m * 1000),
        _GPS_DILUTION,
        _GPS_DILUTION,
        _uint16(view.ground_speed_m_s * 100),
        _centidegrees(math.atan2(east, north)),
        _GPS_SATELLITES,
    )


def wind(view: View) -> Message:
    """WIND: where it comes from, in degrees clockwise from north, and how strong it is."""
    east, north, up = view.snapshot.wind_m_s
    speed_m_s = math.sqrt(east * east + north * north + up * up)
    return mavlink.MAVLink_wind_message(math.degrees(math.atan2(-east, -north)), speed_m_s, -up)


def nav_controller_output(view: View) -> Message:
    """NAV_CONTROLLER_OUTPUT: errors as wanted minus actual, cross-track positive left of the path."""
    now = view.snapshot
    bearing = _target_bearing_deg(view)
    distance_m = _uint16(now.distance_to_waypoint_m)
    roll_deg, pitch_deg = -math.degrees(now.bank), math.degrees(now.climb_angle)
    airspeed_error = now.airspeed_wanted_m_s - now.airspeed_m_s
    return mavlink.MAVLink_nav_controller_output_message(
        roll_deg, pitch_deg, bearing, bearing, distance_m, -now.altitude_error_m, airspeed_error, now.cross_track_m
    )


def _target_bearing_deg(view: View) -> int:
    """Bearing of the current item, of the nose where that has no position; -180 to 180."""
    seq = view.snapshot.current_seq
    item = view.mission[seq] if 0 < seq < len(view.mission) else None
    if item is None or not (item.lat_e7 or item.lon_e7):
        return round(math.degrees(view.yaw))
    x_m, y_m = view.frame.from_e7(item.lat_e7, item.lon_e7)
    here_x_m, here_y_m, _ = view.snapshot.position_m
    return round(math.degrees(math.atan2(x_m - here_x_m, y_m - here_y_m)))
