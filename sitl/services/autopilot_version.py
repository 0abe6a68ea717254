"""AUTOPILOT_VERSION: what this endpoint can do, and nothing it cannot."""

from pymavlink.dialects.v20 import ardupilotmega as mavlink

from sitl.services.peer import Message

CAPABILITIES = (
    mavlink.MAV_PROTOCOL_CAPABILITY_MISSION_FLOAT
    | mavlink.MAV_PROTOCOL_CAPABILITY_MISSION_INT
    | mavlink.MAV_PROTOCOL_CAPABILITY_MISSION_FENCE
    | mavlink.MAV_PROTOCOL_CAPABILITY_MISSION_RALLY
    | mavlink.MAV_PROTOCOL_CAPABILITY_COMMAND_INT
    | mavlink.MAV_PROTOCOL_CAPABILITY_MAVLINK2
    | mavlink.MAV_PROTOCOL_CAPABILITY_PARAM_FLOAT
    | mavlink.MAV_PROTOCOL_CAPABILITY_PARAM_ENCODE_C_CAST
)

_ARDUPLANE = (4, 6, 0)
"""The ArduPlane whose dialect is spoken; stations choose names and numbers by it."""

_OFFICIAL = mavlink.FIRMWARE_VERSION_TYPE_OFFICIAL


def autopilot_version(sysid: int) -> Message:
    """AUTOPILOT_VERSION of the endpoint with this system id."""
    major, minor, patch = _ARDUPLANE
    version = major << 24 | minor << 16 | patch << 8 | _OFFICIAL
    custom = tuple(b"skein".ljust(8, b"\0"))
    return mavlink.MAVLink_autopilot_version_message(
        CAPABILITIES, version, 0, 0, 0, custom, custom, custom, 0, 0, sysid
    )
