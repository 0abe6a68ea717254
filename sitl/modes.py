"""Flight modes, numbered as ArduPlane's custom_mode."""

from enum import IntEnum


class Mode(IntEnum):
    """The modes an endpoint has. It starts in MANUAL, in which it stays on its launcher."""

    MANUAL = 0
    AUTO = 10
    RTL = 11
    LOITER = 12
    TAKEOFF = 13
    GUIDED = 15
