"""The least delay that brings a loop to the edge of stability, by a sweep over frequencies.

At that edge something oscillates for ever: det(I + diag(g(w)) B e^{-jw delay}) = 0. So an eigenvalue mu of -diag(g) B
lies on the unit circle, and the delay is its angle over w. For a loop that is stable without delay the least such delay
is the margin, since roots move continuously with it.
"""

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np
import numpy.typing as npt
from scipy.optimize import brentq

Array = npt.NDArray[np.float64]
Complex = npt.NDArray[np.complex128]


class Crossing(NamedTuple):
    """Where stability ends: delay, frequency of what swings then, and by how much each row of the block does."""

    delay_s: float
    frequency_rad_s: float
    swing: Array


TINY = 1e-300
"""Where a row hears nothing, mu = 0 has a logarithm all the same."""
NEVER = Crossing(math.inf, math.nan, np.zeros(0))
"""Stable at any delay."""


def first_crossing(block: Array, transfer: Callable[[Array], Complex], frequencies: Array) -> Crossing:
    """The crossing of least delay of a loop that is stable without delay.

    Args:
        block: B, how the rows hear each other, (m, m).
        transfer: g, from frequencies (k,) in rad/s to each row's answer to what it hears, own feedback closed, (k, m).
        frequencies: to look at, ascending.
    """

    def level(w: float, i: int) -> float:
        return float(np.log(np.abs(_loops(block, transfer, np.array([w]))[0, i])))

    levels = np.log(np.abs(_loops(block, transfer, frequencies)) + TINY)
    first = NEVER
    for k, i in zip(*np.nonzero(np.sign(levels[:-1]) != np.sign(levels[1:])), strict=True):
        w = brentq(level, frequencies[k], frequencies[k + 1], args=(i,), xtol=1e-12, rtol=1e-12)
        mu, vectors = np.linalg.eig(-transfer(np.array([w]))[0, :, None] * block)
        nearest = int(np.argmin(np.abs(np.abs(mu) - 1.0)))
        delay = (float(np.angle(mu[nearest])) % (2.0 * math.pi)) / w
        if delay < first.delay_s:
            first = Crossing(delay, w, np.abs(vectors[:, nearest]))
    return first


def _loops(block: Array, transfer: Callable[[Array], Complex], frequencies: Array) -> Complex:
    """The eigenvalues mu at each frequency, by size, (k, m): their sizes are continuous in frequency."""
    mu: Complex = np.linalg.eigvals(-transfer(frequencies)[:, :, None] * block).astype(np.complex128)
    return np.take_along_axis(mu, np.argsort(np.abs(mu), axis=1), axis=1)
