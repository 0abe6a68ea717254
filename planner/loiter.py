"""Where vehicles loiter after their arrival: at their targets, stacked where circles would come too close."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from missions.errors import InputError

STACK_M = 40.0
"""Between the altitudes of circles that would come too close (MODEL, section 5)."""

TOLERANCE_M = 0.05
"""What the wire's resolution takes from that."""


@dataclass(frozen=True)
class Circle:
    """A loiter circle in the local frame, metres."""

    x_m: float
    y_m: float
    z_m: float
    radius_m: float


def stack(names: Sequence[str], circles: Sequence[Circle], separation_m: float, altitude_max_m: float) -> list[Circle]:
    """Lift each circle by as few steps as keep it `STACK_M` from all earlier ones that it would come too close to.

    Raises:
        InputError: there is no room below `altitude_max_m`.
    """
    stacked: list[Circle] = []
    for name, circle in zip(names, circles, strict=True):
        taken = [other.z_m for other in stacked if _gap_m(circle, other) < separation_m]
        steps = 0
        while any(abs(circle.z_m + steps * STACK_M - z) < STACK_M for z in taken):
            steps += 1
        lifted = Circle(circle.x_m, circle.y_m, circle.z_m + steps * STACK_M, circle.radius_m)
        if lifted.z_m > altitude_max_m:
            raise InputError(
                f"{name}: its loiter, stacked above others at {lifted.z_m:.0f} m, lies above limits.altitude_max_m = "
                f"{altitude_max_m:g}; raise that, or move its target down or away from others"
            )
        stacked.append(lifted)
    return stacked


def meeting(circles: Sequence[Circle], separation_m: float) -> list[tuple[int, int]]:
    """Pairs of circles, in order, that come nearer than `separation_m` and are not `STACK_M` apart in altitude."""
    centres = np.array([(circle.x_m, circle.y_m) for circle in circles])
    reach = separation_m + 2.0 * max(circle.radius_m for circle in circles)
    return [
        (i, j)
        for i, j in sorted(cKDTree(centres).query_pairs(reach))
        if _gap_m(circles[i], circles[j]) < separation_m - TOLERANCE_M
        and abs(circles[i].z_m - circles[j].z_m) < STACK_M - TOLERANCE_M
    ]


def _gap_m(a: Circle, b: Circle) -> float:
    """Horizontal distance between the nearest points of two circles."""
    apart = math.hypot(a.x_m - b.x_m, a.y_m - b.y_m)
    return max(0.0, apart - a.radius_m - b.radius_m, abs(a.radius_m - b.radius_m) - apart)
