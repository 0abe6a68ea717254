"""HEARTBEAT in ArduPlane's dialect."""

from pymavlink.dialects.v20 import ardupilotmega as mavlink

from sitl.modes import Mode
from sitl.services.peer import Message
from sitl.snapshot import Snapshot

_MAVLINK_VERSION = 3

_MANUAL = (
    mavlink.MAV_MODE_FLAG_MANUAL_INPUT_ENABLED
    | mavlink.MAV_MODE_FLAG_STABILIZE_ENABLED
    | mavlink.MAV_MODE_FLAG_CUSTOM_MODE_ENABLED
)
"""81, as ArduPlane's simulator reports MANUAL."""


def heartbeat(snapshot: Snapshot) -> Message:
    """HEARTBEAT: mode, armed or not, standing by or active (in the air), critical in a failsafe."""
    base_mode = _MANUAL
    if snapshot.mode != Mode.MANUAL:
        base_mode |= mavlink.MAV_MODE_FLAG_GUIDED_ENABLED
    if snapshot.armed:
        base_mode |= mavlink.MAV_MODE_FLAG_SAFETY_ARMED
    if snapshot.failsafe:
        status = mavlink.MAV_STATE_CRITICAL
    else:
        status = mavlink.MAV_STATE_ACTIVE if snapshot.airborne else mavlink.MAV_STATE_STANDBY
    return mavlink.MAVLink_heartbeat_message(
        mavlink.MAV_TYPE_FIXED_WING,
        mavlink.MAV_AUTOPILOT_ARDUPILOTMEGA,
        base_mode,
        int(snapshot.mode),
        status,
        _MAVLINK_VERSION,
    )
