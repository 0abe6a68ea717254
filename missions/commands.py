"""The MAVLink commands and frames that Skein's missions use (MAV_CMD, MAV_FRAME)."""

from enum import IntEnum


class Command(IntEnum):
    """MAV_CMD numbers of the mission items that Skein writes and flies."""

    NAV_WAYPOINT = 16
    NAV_LOITER_UNLIM = 17
    NAV_TAKEOFF = 22
    DO_CHANGE_SPEED = 178


class Frame(IntEnum):
    """MAV_FRAME numbers. On the wire the *_INT forms (5, 6) mean the same as 0 and 3."""

    GLOBAL = 0
    """Altitude AMSL."""
    MISSION = 2
    """An item without a position."""
    GLOBAL_RELATIVE_ALT = 3
    """Altitude above home."""
    GLOBAL_INT = 5
    GLOBAL_RELATIVE_ALT_INT = 6


NAVIGATION = frozenset({Command.NAV_WAYPOINT, Command.NAV_LOITER_UNLIM})
"""Commands whose item is a point that the path goes through."""
