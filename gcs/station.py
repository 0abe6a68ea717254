"""Who the station is on the MAVLink network."""

from pymavlink.dialects.v20 import ardupilotmega as mavlink

from sitl.services.peer import Message

SYSID = 255
COMPID = int(mavlink.MAV_COMP_ID_MISSIONPLANNER)

_MAVLINK_VERSION = 3


def heartbeat() -> Message:
    """The station's own HEARTBEAT."""
    return mavlink.MAVLink_heartbeat_message(
        mavlink.MAV_TYPE_GCS, mavlink.MAV_AUTOPILOT_INVALID, 0, 0, mavlink.MAV_STATE_ACTIVE, _MAVLINK_VERSION
    )


def is_for_station(message: Message) -> bool:
    """Whether a message with a target is meant for this station."""
    return getattr(message, "target_system", 0) in (0, SYSID)
