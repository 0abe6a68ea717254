"""Numbers in files as MISSION_ITEM_INT carries them."""

import math

from missions.commands import Frame
from missions.mission import as_float32, position_scale

_LARGEST_INT = 2**31 - 1


def position_on_wire(value: float, frame: int) -> int:
    """Param5 or param6 (degrees, metres or a plain number, by the frame) as the wire's whole number.

    Raises:
        ValueError: the wire cannot carry it; the message says why.
    """
    scale = position_scale(frame)
    what = {1.0: "a whole number, as frame 2 has no position", 1e4: "metres"}.get(scale, "degrees")
    if not (math.isfinite(value) and abs(value * scale) <= _LARGEST_INT):
        raise ValueError(f"must be {what}, got {value:g}")
    scaled = value * scale
    if frame == Frame.MISSION and scaled != int(scaled):
        raise ValueError(f"must be {what}, got {value:g}; say frame 0 or 3 if this is a place")
    return round(scaled)


def param_on_wire(value: float) -> float:
    """A parameter or an altitude; NaN is a default.

    Raises:
        ValueError: it is infinite, or too large for the wire.
    """
    if math.isinf(as_float32(value)):
        raise ValueError(f"must be a number that MAVLink can carry, got {value:g}")
    return value
