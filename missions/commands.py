"""The MAVLink commands and frames that Skein's missions use (MAV_CMD, MAV_FRAME)."""

from enum import IntEnum


class Command(IntEnum):
    """MAV_CMD numbers of the items that Skein's missions, fences and rally points are made of."""

    NAV_WAYPOINT = 16
    NAV_LOITER_UNLIM = 17
    NAV_LOITER_TURNS = 18
    NAV_LOITER_TIME = 19
    NAV_RETURN_TO_LAUNCH = 20
    NAV_LAND = 21
    NAV_TAKEOFF = 22
    NAV_LOITER_TO_ALT = 31
    DO_JUMP = 177
    DO_CHANGE_SPEED = 178
    DO_LAND_START = 189
    NAV_FENCE_RETURN_POINT = 5000
    NAV_FENCE_POLYGON_VERTEX_INCLUSION = 5001
    NAV_FENCE_POLYGON_VERTEX_EXCLUSION = 5002
    NAV_FENCE_CIRCLE_INCLUSION = 5003
    NAV_FENCE_CIRCLE_EXCLUSION = 5004
    NAV_RALLY_POINT = 5100


class Frame(IntEnum):
    """MAV_FRAME numbers. On the wire the *_INT forms (5, 6, 11) mean the same as 0, 3 and 10."""

    GLOBAL = 0
    """Altitude AMSL."""
    MISSION = 2
    """An item without a position."""
    GLOBAL_RELATIVE_ALT = 3
    """Altitude above home."""
    GLOBAL_INT = 5
    GLOBAL_RELATIVE_ALT_INT = 6
    GLOBAL_TERRAIN_ALT = 10
    """Altitude above the ground below."""
    GLOBAL_TERRAIN_ALT_INT = 11


LOCAL_FRAMES = frozenset({1, 4, 7, 8, 9, *range(12, 22)})
"""MAV_FRAME numbers in which a position is metres from some place near the vehicle."""
LAST_FRAME = 21
"""MAV_FRAME_LOCAL_FLU."""

LAST_NAV = 95
"""MAV_CMD_NAV_LAST: commands up to it are ways to fly, most of them to a place."""

NAVIGATION = frozenset({Command.NAV_WAYPOINT, Command.NAV_LOITER_UNLIM})
"""Commands whose item is a point that the path goes through."""

PLACES = frozenset(
    {
        Command.NAV_WAYPOINT,
        Command.NAV_LOITER_UNLIM,
        Command.NAV_LOITER_TURNS,
        Command.NAV_LOITER_TIME,
        Command.NAV_LOITER_TO_ALT,
        Command.NAV_LAND,
        Command.NAV_TAKEOFF,
    }
)
"""Commands whose item has a latitude, a longitude and an altitude."""
