"""Flight modes by the numbers of each autopilot: custom_mode of its HEARTBEAT, parameters of DO_SET_MODE."""

from missions.autopilot import Autopilot
from missions.errors import InputError
from sitl.modes import Mode

_PX4_AUTO = 4
_PX4 = {
    Mode.MANUAL: (1, 0),
    Mode.TAKEOFF: (_PX4_AUTO, 2),
    Mode.LOITER: (_PX4_AUTO, 3),
    Mode.AUTO: (_PX4_AUTO, 4),
    Mode.RTL: (_PX4_AUTO, 5),
}
"""Main and sub mode (PX4's px4_custom_mode.h); AUTO is its Mission, LOITER its Hold."""


def mode_params(mode: Mode, autopilot: Autopilot) -> tuple[float, float]:
    """DO_SET_MODE's param2 and param3.

    Raises:
        InputError: the autopilot has no such mode.
    """
    if autopilot is Autopilot.ardupilot:
        return float(mode), 0.0
    if mode not in _PX4:
        raise InputError(f"PX4 has no mode {mode.name}; it has {', '.join(one.name for one in _PX4)}")
    main, sub = _PX4[mode]
    return float(main), float(sub)


def custom_mode(mode: Mode, autopilot: Autopilot) -> int:
    """HEARTBEAT's custom_mode. Raises InputError when the autopilot has no such mode."""
    first, second = map(int, mode_params(mode, autopilot))
    return first if autopilot is Autopilot.ardupilot else first << 16 | second << 24


def mode_name(number: int, autopilot: Autopilot) -> str:
    """The name of a HEARTBEAT's custom_mode, its number where Skein has no such mode."""
    modes = Mode if autopilot is Autopilot.ardupilot else _PX4
    return next((mode.name for mode in modes if custom_mode(mode, autopilot) == number), f"mode {number}")
