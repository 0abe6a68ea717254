"""The box (1) and the constraints (12) on a polyline, and the lengths of its legs once fillets round the corners."""

import math
from typing import Any

import numpy as np
import numpy.typing as npt

from missions.compiled import jit
from planner.cost.problem import PathProblem

FloatArray = npt.NDArray[np.float64]

SLOPE_UNIT = 0.1
"""Slopes beyond their limits count in these; the limits themselves may be 0."""
SHORT_M = 1e-6
"""Stands for the length of a leg without any."""


@jit
def broken_limits(corners: Any, bounds: Any, arcs: Any) -> tuple[int, float]:
    """Violations of the box (1) and the constraints (12), and by how much in all, relative to each limit.

    Fills in `arcs`: horizontal length of each leg between the middles of the fillets at its ends. Slopes are along
    those, as the aircraft flies them.
    """
    legs = len(corners) - 1
    violations = 0
    excess = 0.0
    for k in range(1, legs):
        x, y, z = corners[k, 0], corners[k, 1], corners[k, 2]
        outside = max(0.0, bounds.x_min_m - x, x - bounds.x_max_m) + max(0.0, bounds.y_min_m - y, y - bounds.y_max_m)
        outside += max(0.0, bounds.z_min_m - z, z - bounds.z_max_m)
        if outside > 0.0:
            violations += 1
            excess += outside / 1000.0

    dx, dy = corners[1, 0] - corners[0, 0], corners[1, 1] - corners[0, 1]
    across = max(math.sqrt(dx * dx + dy * dy), SHORT_M)
    trim_before = flown = 0.0
    for k in range(legs):
        room = across if k == 0 else across / 2.0
        turn = trim = tangent = 0.0
        across_next = across
        if k + 1 < legs:
            dx_next, dy_next = corners[k + 2, 0] - corners[k + 1, 0], corners[k + 2, 1] - corners[k + 1, 1]
            across_next = max(math.sqrt(dx_next * dx_next + dy_next * dy_next), SHORT_M)
            room = min(room, across_next if k + 2 == legs else across_next / 2.0)
            turn = abs(math.atan2(dx * dy_next - dy * dx_next, dx * dx_next + dy * dy_next))
            half_tangent = math.tan(turn / 2.0)
            tangent = bounds.fillet_radius_m * half_tangent
            trim = min(tangent, room) * (1.0 - turn / (2.0 * half_tangent) if half_tangent > 1e-6 else 0.0)
            dx, dy = dx_next, dy_next
        dz = corners[k + 1, 2] - corners[k, 2]
        length = math.sqrt(across * across + dz * dz)
        arcs[k] = max(across - trim_before - trim, SHORT_M)
        flown += arcs[k]
        slope = dz / arcs[k]
        for over in (
            1.0 - length / bounds.leg_min_m,
            length / bounds.leg_max_m - 1.0,
            turn / bounds.turn_max - 1.0,
            min(tangent / room - 1.0, 10.0),
            min((slope - bounds.slope_max) / SLOPE_UNIT, 10.0),
            min((bounds.slope_min - slope) / SLOPE_UNIT, 10.0),
        ):
            if over > 0.0:
                violations += 1
                excess += over
        across, trim_before = across_next, trim
    if flown < bounds.length_min_m:
        violations += 1
        excess += 1.0 - flown / bounds.length_min_m
    return violations, excess


def with_progress(corners_m: FloatArray, problem: PathProblem) -> FloatArray:
    """(m, 4) corners of a path and the part of the flight after which each is passed, for `PathProblem.others`."""
    arcs = np.empty(len(corners_m) - 1)
    broken_limits(corners_m, problem.bounds, arcs)
    passed = np.concatenate([[0.0], np.cumsum(arcs)])
    return np.column_stack([corners_m, passed / passed[-1]])
