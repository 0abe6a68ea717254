"""What a path is as it is flown, seen from above: its legs, turns, and arcs between the middles of fillets; and how
these change as corners move."""

import math
from typing import Any

from missions.compiled import jit

SHORT_M = 1e-3
"""Stands for the length of a leg without any."""
STRAIGHT = 1e-6
"""Half of a turn that has no fillet, radians."""


@jit
def fly(corners: Any, fillet_radius_m: float, across: Any, turns: Any, arcs: Any) -> None:
    """Fill in horizontal lengths (legs,), signed turns at corners (legs + 1,) and arcs (legs,) of a path; the arcs are
    those of `planner.cost.constraints.broken_limits`."""
    for k in range(len(arcs)):
        dx, dy = corners[k + 1, 0] - corners[k, 0], corners[k + 1, 1] - corners[k, 1]
        across[k] = max(math.sqrt(dx * dx + dy * dy), SHORT_M)
        arcs[k] = across[k]
    turns[0] = turns[len(arcs)] = 0.0
    for k in range(1, len(arcs)):
        ax, ay = corners[k, 0] - corners[k - 1, 0], corners[k, 1] - corners[k - 1, 1]
        bx, by = corners[k + 1, 0] - corners[k, 0], corners[k + 1, 1] - corners[k, 1]
        turns[k] = math.atan2(ax * by - ay * bx, ax * bx + ay * by)
        trim, _, _ = _trim(k, across, turns[k], fillet_radius_m)
        arcs[k - 1] -= trim
        arcs[k] -= trim


@jit
def add_flown_slopes(
    corners: Any,
    fillet_radius_m: float,
    across: Any,
    turns: Any,
    across_slope: Any,
    turn_slope: Any,
    arc_slope: Any,
    gradient: Any,
) -> None:
    """Add to the gradient (legs + 1, 3) in the corners what is due to slopes in across, |turns| and arcs.

    Lengths and corners count in one unit, whatever it is in the slopes in turns: those are per (that unit = 1 km) and
    radian, and radii and legs in metres.
    """
    legs = len(across)
    for k in range(legs):
        across_slope[k] += arc_slope[k]
    for k in range(1, legs):
        shortened = arc_slope[k - 1] + arc_slope[k]
        _, by_turn, by_room = _trim(k, across, turns[k], fillet_radius_m)
        before, after = room_m(k, across)
        if before < after:
            across_slope[k - 1] -= shortened * by_room * (before / across[k - 1])
        else:
            across_slope[k] -= shortened * by_room * (after / across[k])
        slope = turn_slope[k] - shortened * by_turn * 1e-3
        if slope != 0.0:
            _add_turn_slope(gradient, k, corners, slope if turns[k] >= 0.0 else -slope, across[k - 1], across[k])
    for k in range(legs):
        pull = across_slope[k] / across[k]
        dx, dy = corners[k + 1, 0] - corners[k, 0], corners[k + 1, 1] - corners[k, 1]
        gradient[k, 0] -= pull * dx
        gradient[k, 1] -= pull * dy
        gradient[k + 1, 0] += pull * dx
        gradient[k + 1, 1] += pull * dy


@jit
def room_m(k: int, across: Any) -> tuple[float, float]:
    """What the legs before and after corner k leave for its fillet: half of each, all of the first and the last."""
    before = across[0] if k == 1 else 0.5 * across[k - 1]
    after = across[k] if k + 1 == len(across) else 0.5 * across[k]
    return before, after


@jit
def _trim(k: int, across: Any, turn: float, fillet_radius_m: float) -> tuple[float, float, float]:
    """By how much the fillet at corner k shortens each of its legs, and the slopes of that in |turn| and in the room
    there is, when that decides."""
    half = 0.5 * abs(turn)
    if half < STRAIGHT:
        return 0.0, 0.0, 0.0
    before, after = room_m(k, across)
    room = min(before, after)
    half_tangent = math.tan(half)
    if fillet_radius_m * half_tangent <= room:
        return fillet_radius_m * (half_tangent - half), 0.5 * fillet_radius_m * half_tangent * half_tangent, 0.0
    part = 1.0 - half / half_tangent
    sine = math.sin(half)
    return room * part, 0.5 * room * (half / (sine * sine) - 1.0 / half_tangent), part


@jit
def _add_turn_slope(gradient: Any, k: int, corners: Any, slope: float, before: float, after: float) -> None:
    """A slope in the signed turn at corner k, kilometres a radian."""
    ax, ay = corners[k, 0] - corners[k - 1, 0], corners[k, 1] - corners[k - 1, 1]
    bx, by = corners[k + 1, 0] - corners[k, 0], corners[k + 1, 1] - corners[k, 1]
    scale_a, scale_b = 1e3 * slope / (before * before), 1e3 * slope / (after * after)
    gradient[k - 1, 0] -= ay * scale_a
    gradient[k - 1, 1] += ax * scale_a
    gradient[k, 0] += ay * scale_a + by * scale_b
    gradient[k, 1] -= ax * scale_a + bx * scale_b
    gradient[k + 1, 0] -= by * scale_b
    gradient[k + 1, 1] += bx * scale_b
