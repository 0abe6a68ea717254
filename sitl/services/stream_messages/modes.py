"""The standard modes protocol: which modes there are, by name, and which it is in."""

from pymavlink.dialects.v20 import ardupilotmega as mavlink

from sitl.modes import Mode
from sitl.services.mode_messages import AvailableModes, CurrentMode
from sitl.services.peer import Message
from sitl.services.stream_messages.view import View

STANDARD_MODES = {
    Mode.AUTO: int(mavlink.MAV_STANDARD_MODE_MISSION),
    Mode.RTL: int(mavlink.MAV_STANDARD_MODE_SAFE_RECOVERY),
    Mode.TAKEOFF: int(mavlink.MAV_STANDARD_MODE_TAKEOFF),
}
"""The modes that mean the same on every autopilot (MAV_STANDARD_MODE); the others are ArduPlane's own."""

_OWN = int(mavlink.MAV_STANDARD_MODE_NON_STANDARD)


def current_mode(view: View) -> Message:
    """CURRENT_MODE."""
    mode = view.snapshot.mode
    return CurrentMode(STANDARD_MODES.get(mode, _OWN), int(mode), int(mode))


def available_modes(index: int) -> tuple[Message, ...]:
    """AVAILABLE_MODES of the mode with this index, from 1; of all for 0; none when there is no such mode."""
    modes = list(Mode)
    indices = range(1, len(modes) + 1)
    return tuple(
        AvailableModes(len(modes), at, STANDARD_MODES.get(mode, _OWN), int(mode), 0, mode.name.encode())
        for at, mode in zip(indices, modes, strict=True)
        if index in (0, at)
    )
