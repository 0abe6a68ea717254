"""The formation law: along-track acceleration from the neighbours' and the own deviations (equation (15))."""

from typing import NamedTuple

from sitl.guidance.path_errors import PathErrors
from sitl.guidance.path_law import clamp

CATCH_UP_SPEED_M_S = 5.0
"""Corrections ask for at most this closing speed: each of them is clipped at k3 times it."""


class Gains(NamedTuple):
    """k1 (1/s^2), k2 (1/s) of the neighbours; k3 (1/s) and the pin k0 (1/s^2) of the own schedule."""

    k1: float
    k2: float
    k3: float
    k0: float


def correction(
    along: float, along_rate: float, other_along: float, other_along_rate: float, weight: float, gains: Gains
) -> float:
    """One neighbour's part of c: a_pq [k1 (e_q - e_p) + k2 (e_q' - e_p')], both sides of the same, delayed moment."""
    return weight * (gains.k1 * (other_along - along) + gains.k2 * (other_along_rate - along_rate))


def formation_acceleration(errors: PathErrors, corrections: float, gains: Gains) -> float:
    """u_t = s_ref'' + sat(c) - k3 e' - sat(k0 e): it replaces a plain autopilot's airspeed hold."""
    limit = gains.k3 * CATCH_UP_SPEED_M_S
    return (
        errors.reference_acceleration
        + clamp(corrections, -limit, limit)
        - gains.k3 * errors.along_rate
        - clamp(gains.k0 * errors.along, -limit, limit)
    )
