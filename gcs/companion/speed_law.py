"""The consensus law as airspeeds for a plain autopilot, which holds what a DO_CHANGE_SPEED asks for.

The law (15) gives accelerations 25 times a second; an autopilot takes a speed about once a second and reaches it within
some two seconds. So the deviation becomes a speed: V = s_ref' + sat(-OWN e + sum_q a_pq NEIGHBOUR (e_q - e_p)) over
ground, less the tailwind as it is measured. Gains are low enough for a second of hold and the autopilot's lag.
"""

from collections.abc import Iterable

from sitl.guidance.path_law import clamp

OWN = 0.05
"""1/s, of the own deviation from the schedule."""
NEIGHBOUR = 0.08
"""1/s, of the difference to the neighbours, whose weights add up to 1 at most."""
CATCH_UP_M_S = 5.0
"""Corrections change the speed by no more."""


def speed_over_ground_m_s(scheduled_m_s: float, along_m: float, neighbours: Iterable[tuple[float, float]]) -> float:
    """The wanted speed along the path.

    Args:
        scheduled_m_s: s_ref'.
        along_m: e, metres ahead of the schedule.
        neighbours: (a_pq, e_q) of each that is heard, of the same moment as `along_m`.
    """
    correction = -OWN * along_m
    for weight, other_along_m in neighbours:
        correction += weight * NEIGHBOUR * (other_along_m - along_m)
    return scheduled_m_s + clamp(correction, -CATCH_UP_M_S, CATCH_UP_M_S)
