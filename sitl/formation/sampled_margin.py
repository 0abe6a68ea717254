"""The delay margin of a law that acts once a tick, its command held, on a plant of ticks: a point or an aircraft."""

import math

import numpy as np

from sitl.formation.crossing import NEVER, Array, Complex, Crossing, first_crossing
from sitl.formation.law import Gains
from sitl.formation.linear_formation import Mode, closed_loop
from sitl.formation.plant import Plant
from sitl.ticks import TICK_S

FREQUENCIES_RAD_S = np.geomspace(1e-6, 1.0, 240) * math.pi / TICK_S
"""Where crossings are looked for: up to half the sampling frequency."""
NEUTRAL = 1e-6
"""A root this far outside the unit circle counts as on it: where nothing pins it, the formation drifts as a whole."""


def sampled_margin(mode: Mode, gains: Gains, plant: Plant) -> Crossing:
    """Where delay ends the stability of a mode; at 0 when it is not stable without delay.

    A delay of k ticks is z^-k, and with z = e^{jw tick} that has a meaning for any real k. The margin is the k, times
    the tick, at which a root lies on the unit circle: whole ticks up to it are stable, the next one is not.
    """
    if gains.k1 == gains.k2 == 0.0:
        return NEVER
    heard = np.zeros(len(plant.B))
    heard[:2] = gains.k1, gains.k2
    own = [_with_own_feedback(plant, damping, pin) for damping, pin in zip(mode.damping, mode.pins, strict=True)]

    def transfer(w: Array) -> Complex:
        z = np.exp(1j * w * TICK_S)[:, None, None] * np.eye(len(plant.B))
        return np.stack([np.linalg.solve(z - A, plant.B[:, None])[:, :, 0] @ heard for A in own], axis=1)

    undelayed = closed_loop([mode], plant.A, plant.B, np.outer(plant.B, heard))
    if np.abs(np.linalg.eigvals(undelayed)).max() > 1.0 + NEUTRAL:
        return Crossing(0.0, math.nan, np.ones(len(mode.block)))
    return first_crossing(mode.block, transfer, FREQUENCIES_RAD_S)


def _with_own_feedback(plant: Plant, damping: float, pin: float) -> Array:
    """A vehicle's next state with its own feedback closed, (d, d)."""
    own = np.zeros(len(plant.B))
    own[:2] = pin, damping
    return plant.A - np.outer(plant.B, own)
