"""How far a vehicle is with its mission."""

from pymavlink.dialects.v20 import ardupilotmega as mavlink

from sitl.modes import Mode
from sitl.services.opaque_id import MissionCurrent
from sitl.services.peer import Message
from sitl.services.stream_messages.view import View

_NO_MISSION = 0xFFFF
_IN_MISSION_MODE, _NOT_IN_MISSION_MODE = 1, 2


def mission_current(view: View) -> Message:
    """MISSION_CURRENT with total (home not counted), state, mode and the plan's opaque id."""
    now = view.snapshot
    total = len(view.mission) - 1 or _NO_MISSION
    mode = _IN_MISSION_MODE if now.mode == Mode.AUTO else _NOT_IN_MISSION_MODE
    return MissionCurrent(now.current_seq, total, _mission_state(view), mode, view.plan_ids)


def _mission_state(view: View) -> int:
    now = view.snapshot
    if len(view.mission) == 1:
        return int(mavlink.MISSION_STATE_NO_MISSION)
    if now.mission_complete:
        return int(mavlink.MISSION_STATE_COMPLETE)
    if not now.airborne:
        return int(mavlink.MISSION_STATE_NOT_STARTED)
    return int(mavlink.MISSION_STATE_ACTIVE if now.mode == Mode.AUTO else mavlink.MISSION_STATE_PAUSED)
