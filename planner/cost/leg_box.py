"""The box in plan around a leg: the quick first question whether something is near it."""

from typing import Any

from missions.compiled import jit


@jit
def leg_box(p: Any, q: Any) -> tuple[float, float, float, float]:
    """West, east, south and north edge of the leg from p to q, metres."""
    return min(p[0], q[0]), max(p[0], q[0]), min(p[1], q[1]), max(p[1], q[1])


@jit
def apart(box: tuple[float, float, float, float], x: float, y: float, reach: float) -> bool:
    """Whether a circle lies wholly outside a leg's box."""
    west, east, south, north = box
    return west > x + reach or east < x - reach or south > y + reach or north < y - reach
