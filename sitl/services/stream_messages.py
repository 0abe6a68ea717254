"""A vehicle's state as MAVLink telemetry messages.

This is the boundary at which Skein's axes (x east, y north, z up; angles anticlockwise from +x; bank positive left)
become MAVLink's (north, east, down; clockwise from north; roll positive right), and the only one.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

from pymavlink.dialects.v20 import ardupilotmega as mavlink

from missions.airframe import GRAVITY_M_S2
from missions.commands import NAVIGATION
from missions.frame import LocalFrame
from missions.mission import Mission, degrees_to_e7
from sitl.modes import Mode
from sitl.services.opaque_id import MissionCurrent
from sitl.services.peer import Message
from sitl.snapshot import Snapshot

_GPS_SATELLITES = 12
_GPS_DILUTION = 80  # hundredths
_SENSORS = (
    mavlink.MAV_SYS_STATUS_SENSOR_3D_GYRO
    | mavlink.MAV_SYS_STATUS_SENSOR_3D_ACCEL
    | mavlink.MAV_SYS_STATUS_SENSOR_3D_MAG
    | mavlink.MAV_SYS_STATUS_SENSOR_ABSOLUTE_PRESSURE
    | mavlink.MAV_SYS_STATUS_SENSOR_DIFFERENTIAL_PRESSURE
    | mavlink.MAV_SYS_STATUS_SENSOR_GPS
    | mavlink.MAV_SYS_STATUS_AHRS
    | mavlink.MAV_SYS_STATUS_PREARM_CHECK
)


@dataclass(frozen=True)
class View:
    """What the telemetry of one instant is made from.

    Attributes:
        snapshot: the vehicle's state.
        frame: the local frame of its position.
        mission: the mission it holds, home first.
        mission_id: that mission's opaque id.
    """

    snapshot: Snapshot
    frame: LocalFrame
    mission: Mission
    mission_id: int

    @property
    def time_boot_ms(self) -> int:
        """Simulated time; like every autopilot's, it begins anew after 49.7 days."""
        return round(self.snapshot.time_s * 1000) % 2**32

    @cached_property
    def lat_lon_e7(self) -> tuple[int, int]:
        """Position in 1e-7 degrees."""
        x_m, y_m, _ = self.snapshot.position_m
        return self.frame.to_e7(x_m, y_m)

    @property
    def altitude_m(self) -> float:
        """Altitude AMSL."""
        return self.frame.alt_m + self.snapshot.position_m[2]

    @property
    def ground_speed_m_s(self) -> float:
        """Horizontal speed over the ground."""
        east, north, _ = self.snapshot.ground_velocity_m_s
        return math.hypot(east, north)

    @property
    def yaw(self) -> float:
        """Heading clockwise from north, radians in (-pi, pi]."""
        return math.atan2(math.cos(self.snapshot.heading), math.sin(self.snapshot.heading))


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
        round((view.altitude_m - view.mission.home.alt_m) * 1000),
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


def gps_global_origin(view: View) -> Message:
    """GPS_GLOBAL_ORIGIN: where LOCAL_POSITION_NED is zero."""
    frame = view.frame
    latitude, longitude = degrees_to_e7(frame.lat_deg), degrees_to_e7(frame.lon_deg)
    return mavlink.MAVLink_gps_global_origin_message(latitude, longitude, round(frame.alt_m * 1000))


def home_position(view: View) -> Message:
    """HOME_POSITION."""
    home = view.mission.home
    x_m, y_m = view.frame.from_e7(home.lat_e7, home.lon_e7)
    down_m = view.frame.alt_m - home.alt_m
    nan = math.nan
    return mavlink.MAVLink_home_position_message(
        home.lat_e7, home.lon_e7, round(home.alt_m * 1000), y_m, x_m, down_m, (1.0, 0.0, 0.0, 0.0), nan, nan, nan
    )


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


def sys_status(view: View) -> Message:
    """SYS_STATUS: every sensor in health, no battery modelled."""
    unknown_voltage, unknown = 0xFFFF, -1
    return mavlink.MAVLink_sys_status_message(
        _SENSORS, _SENSORS, _SENSORS, 0, unknown_voltage, unknown, unknown, 0, 0, 0, 0, 0, 0
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
    if not 0 < seq < len(view.mission) or view.mission[seq].command not in NAVIGATION:
        return round(math.degrees(view.yaw))
    x_m, y_m = view.frame.from_e7(view.mission[seq].lat_e7, view.mission[seq].lon_e7)
    here_x_m, here_y_m, _ = view.snapshot.position_m
    return round(math.degrees(math.atan2(x_m - here_x_m, y_m - here_y_m)))


def mission_current(view: View) -> Message:
    """MISSION_CURRENT with total (home not counted), state and the mission's opaque id."""
    now = view.snapshot
    return MissionCurrent(now.current_seq, len(view.mission) - 1, _mission_state(view), 0, view.mission_id)


def _mission_state(view: View) -> int:
    now = view.snapshot
    if len(view.mission) == 1:
        return int(mavlink.MISSION_STATE_NO_MISSION)
    if now.mission_complete:
        return int(mavlink.MISSION_STATE_COMPLETE)
    if not now.airborne:
        return int(mavlink.MISSION_STATE_NOT_STARTED)
    return int(mavlink.MISSION_STATE_ACTIVE if now.mode == Mode.AUTO else mavlink.MISSION_STATE_PAUSED)


def system_time(view: View) -> Message:
    """SYSTEM_TIME: the simulated time since boot; the date is not known."""
    return mavlink.MAVLink_system_time_message(0, view.time_boot_ms)


BUILDERS: dict[int, Callable[[View], Message]] = {
    mavlink.MAVLINK_MSG_ID_ATTITUDE: attitude,
    mavlink.MAVLINK_MSG_ID_GLOBAL_POSITION_INT: global_position,
    mavlink.MAVLINK_MSG_ID_LOCAL_POSITION_NED: local_position,
    mavlink.MAVLINK_MSG_ID_VFR_HUD: vfr_hud,
    mavlink.MAVLINK_MSG_ID_GPS_RAW_INT: gps_raw,
    mavlink.MAVLINK_MSG_ID_SYS_STATUS: sys_status,
    mavlink.MAVLINK_MSG_ID_WIND: wind,
    mavlink.MAVLINK_MSG_ID_NAV_CONTROLLER_OUTPUT: nav_controller_output,
    mavlink.MAVLINK_MSG_ID_MISSION_CURRENT: mission_current,
    mavlink.MAVLINK_MSG_ID_SYSTEM_TIME: system_time,
    mavlink.MAVLINK_MSG_ID_HOME_POSITION: home_position,
    mavlink.MAVLINK_MSG_ID_GPS_GLOBAL_ORIGIN: gps_global_origin,
}
"""Every message that can be streamed or requested, by its id."""
