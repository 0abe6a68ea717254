"""How fast disturbances die out at a delay."""

import math
from collections.abc import Sequence
from functools import cache

import numpy as np
import numpy.typing as npt

from sitl.formation.law import Gains
from sitl.formation.linear_formation import Mode, closed_loop
from sitl.formation.plant import Plant

Array = npt.NDArray[np.float64]

ORDER = 8
"""Of the Pade approximation of the delay; its poles lie far left of what matters."""


def decay_rate(of: Sequence[Mode], gains: Gains, rates: Plant, delay_s: float) -> float:
    """The rate (1/s) at which the slowest of some modes decays; negative when it grows.

    Args:
        of: modes of one formation that separate.
        rates: of a vehicle, in continuous time.
    """
    heard = np.zeros(len(rates.B))
    heard[:2] = gains.k1, gains.k2
    line, enter, leave, through = _delay_line(delay_s)
    size = len(heard) + ORDER
    # A vehicle and what is on its way from it: states x of the plant and xi of the line that y = heard x enters.
    alone = np.zeros((size, size))
    alone[: len(heard), : len(heard)] = rates.A
    alone[len(heard) :, : len(heard)] = np.outer(enter, heard)
    alone[len(heard) :, len(heard) :] = line
    drive = np.concatenate([rates.B, np.zeros(ORDER)])
    late = np.concatenate([through * heard, leave])
    decays = -np.linalg.eigvals(closed_loop(of, alone, drive, np.outer(drive, late))).real
    return float(decays.min())


@cache
def _delay_line(delay_s: float) -> tuple[Array, Array, Array, float]:
    """A state-space form (A, B, C, D) of the diagonal Pade approximation of e^{-s delay}.

    p(-s delay) / p(s delay) with p's coefficients c_j = binomial(N, j) (2 N - j)! / (2 N)!.
    """
    N = ORDER
    c = [math.comb(N, j) * math.factorial(2 * N - j) / math.factorial(2 * N) for j in range(N + 1)]
    below = np.array(c[:N]) / c[N]
    above = np.array([(-1) ** j * cj for j, cj in enumerate(c)]) / c[N]
    through = above[N]
    line = np.diag(np.ones(N - 1), 1)
    line[-1] = -below
    enter = np.zeros(N)
    enter[-1] = 1.0
    leave = above[:N] - through * below
    # The coefficients span ten decades; states in these units have entries of like size.
    scale = 10.0 ** np.arange(N)
    line = line * scale[None, :] / scale[:, None]
    return line / delay_s, enter / scale / delay_s, leave * scale, float(through)
