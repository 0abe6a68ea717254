"""Whether a vehicle is well: SYS_STATUS, BATTERY_STATUS, EKF_STATUS_REPORT, EXTENDED_SYS_STATE, FENCE_STATUS,
SYSTEM_TIME."""

from pymavlink.dialects.v20 import ardupilotmega as mavlink

from sitl.services.peer import Message
from sitl.services.stream_messages.view import View

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
_FENCE = mavlink.MAV_SYS_STATUS_GEOFENCE
_READY = mavlink.MAV_SYS_STATUS_PREARM_CHECK

_EKF_WELL = (
    mavlink.EKF_ATTITUDE
    | mavlink.EKF_VELOCITY_HORIZ
    | mavlink.EKF_VELOCITY_VERT
    | mavlink.EKF_POS_HORIZ_REL
    | mavlink.EKF_POS_HORIZ_ABS
    | mavlink.EKF_POS_VERT_ABS
    | mavlink.EKF_PRED_POS_HORIZ_REL
    | mavlink.EKF_PRED_POS_HORIZ_ABS
)

_FENCE_ID = 1

_UNKNOWN_MV, _UNKNOWN_CENTIDEGREES, _UNKNOWN = 0xFFFF, 0x7FFF, -1
_CELLS = 10


def sys_status(view: View) -> Message:
    """SYS_STATUS: every sensor in health, no battery modelled; the fence's bits and that of the pre-arm checks.

    A fence that is not there is in health too: stations cry breach when the bit goes.
    """
    now = view.snapshot
    present = _SENSORS | (_FENCE if now.fence_enabled or view.plan_ids[_FENCE_ID] else 0)
    enabled = _SENSORS | (_FENCE if now.fence_enabled else 0)
    health = (_SENSORS | _FENCE) & ~(_FENCE if now.breach_status else 0) & ~(0 if now.ready else _READY)
    return mavlink.MAVLink_sys_status_message(
        present, enabled, health, 0, _UNKNOWN_MV, _UNKNOWN, _UNKNOWN, 0, 0, 0, 0, 0, 0
    )


def battery_status(view: View) -> Message:
    """BATTERY_STATUS: one battery of which nothing is known, as in SYS_STATUS, for stations that insist on the message.

    Each value is the one that means "unknown"; the cells of the extension are 0, "no cell".
    """
    return mavlink.MAVLink_battery_status_message(
        0,
        mavlink.MAV_BATTERY_FUNCTION_UNKNOWN,
        mavlink.MAV_BATTERY_TYPE_UNKNOWN,
        _UNKNOWN_CENTIDEGREES,
        [_UNKNOWN_MV] * _CELLS,
        _UNKNOWN,
        _UNKNOWN,
        _UNKNOWN,
        _UNKNOWN,
    )


def ekf_status_report(view: View) -> Message:
    """EKF_STATUS_REPORT: a simulated vehicle knows where it is. Some stations call none armable without it."""
    return mavlink.MAVLink_ekf_status_report_message(_EKF_WELL, 0.0, 0.0, 0.0, 0.0, 0.0)


def extended_sys_state(view: View) -> Message:
    """EXTENDED_SYS_STATE: on the ground, in the air, or on the way from one to the other."""
    return mavlink.MAVLink_extended_sys_state_message(mavlink.MAV_VTOL_STATE_UNDEFINED, int(view.snapshot.landed))


def fence_status(view: View) -> Message:
    """FENCE_STATUS."""
    now = view.snapshot
    return mavlink.MAVLink_fence_status_message(
        int(now.breach_status),
        min(now.breach_count, 0xFFFF),
        int(now.breach_type),
        round(now.breach_time_s * 1000) % 2**32,
    )


def system_time(view: View) -> Message:
    """SYSTEM_TIME: the simulated time since boot, and the date that makes of it."""
    return mavlink.MAVLink_system_time_message(round((view.epoch_s + view.snapshot.time_s) * 1e6), view.time_boot_ms)
