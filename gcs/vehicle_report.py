"""What a vehicle says of itself when it is asked: the station's status of it."""

import time
from typing import Any

from pymavlink.dialects.v20 import ardupilotmega as mavlink

from gcs.flight_modes import mode_name
from gcs.transfers.command import command
from gcs.transfers.errors import TransferError
from gcs.vehicle_link import VehicleLink
from sitl.services.opaque_id import received_opaque_ids

_ASKED = {
    "GLOBAL_POSITION_INT": mavlink.MAVLINK_MSG_ID_GLOBAL_POSITION_INT,
    "VFR_HUD": mavlink.MAVLINK_MSG_ID_VFR_HUD,
    "MISSION_CURRENT": mavlink.MAVLINK_MSG_ID_MISSION_CURRENT,
    "EXTENDED_SYS_STATE": mavlink.MAVLINK_MSG_ID_EXTENDED_SYS_STATE,
    "FENCE_STATUS": mavlink.MAVLINK_MSG_ID_FENCE_STATUS,
}
"""What makes up a report, apart from the HEARTBEAT."""
_NO_MISSION = 0xFFFF
"""MISSION_CURRENT's total where there is none."""
_LANDED = {
    mavlink.MAV_LANDED_STATE_ON_GROUND: "on ground",
    mavlink.MAV_LANDED_STATE_IN_AIR: "in air",
    mavlink.MAV_LANDED_STATE_TAKEOFF: "taking off",
    mavlink.MAV_LANDED_STATE_LANDING: "landing",
}


async def vehicle_report(vehicle: VehicleLink) -> dict[str, Any]:
    """Ask a vehicle for its state.

    Returns:
        By name, with units in the names; None where the vehicle does not tell. "answers" is false when it is heard but
        does not answer, as over a link that goes one way only, or when it does not hear this station.

    Raises:
        TransferError: it has fallen silent.
    """
    try:
        for name, message_id in _ASKED.items():
            if name not in vehicle.latest:
                await command(vehicle, mavlink.MAV_CMD_REQUEST_MESSAGE, float(message_id))  # it comes before its ACK
    except TransferError:
        if not vehicle.heard:
            raise
        return _report(vehicle, answers=False)
    return _report(vehicle, answers=True)


def _report(vehicle: VehicleLink, answers: bool) -> dict[str, Any]:
    heartbeat = vehicle.latest["HEARTBEAT"]
    position, hud, current, state, fence = (vehicle.latest.get(name) for name in _ASKED)
    return {
        "address": str(vehicle.peer),
        "answers": answers,
        "signs": vehicle.signs,
        "mode": mode_name(heartbeat.custom_mode, vehicle.autopilot),
        "armed": bool(heartbeat.base_mode & mavlink.MAV_MODE_FLAG_SAFETY_ARMED),
        "landed_state": _LANDED.get(state.landed_state) if state else None,
        "lat_deg": position.lat / 1e7 if position else None,
        "lon_deg": position.lon / 1e7 if position else None,
        "altitude_m": position.alt / 1000.0 if position else None,
        "relative_altitude_m": position.relative_alt / 1000.0 if position else None,
        "airspeed_m_s": hud.airspeed if hud else None,
        "ground_speed_m_s": hud.groundspeed if hud else None,
        "mission_item": current.seq if current else None,
        "mission_items": current.total if current and current.total != _NO_MISSION else None,
        "mission_id": received_opaque_ids(current)[0] if current else None,
        "fence_breached": bool(fence.breach_status) if fence else None,
        "lost_frames": vehicle.lost_frames,
        "heard_s_ago": round(time.monotonic() - vehicle.heard_at_s, 3),
        "texts": vehicle.texts,
    }
