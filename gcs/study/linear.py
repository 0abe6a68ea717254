"""The law (15) without its clips, in continuous time or tick by tick: how fast what disturbs a formation dies out.

By simulation; what margins and modes say of it is in `sitl.formation`.
"""

import math

import numpy as np
import numpy.typing as npt

from missions.compiled import jit
from sitl.formation.linear_formation import LinearFormation
from sitl.ticks import TICK_S

FloatArray = npt.NDArray[np.float64]

STEPS_A_DELAY = 30
"""Of continuous time; steps are of fourth order."""
WINDOWS = 40
"""What grows is scaled back after each; growth is that over the second half of them."""


def growth_rate(formation: LinearFormation, delay_s: float, duration_s: float) -> float:
    """The rate (1/s) at which a disturbance grows in continuous time, below 0 where it dies out, by simulation."""
    return _rate(formation, delay_s / STEPS_A_DELAY, STEPS_A_DELAY, duration_s, held=False)


def growth_rate_sampled(formation: LinearFormation, delay_ticks: int, duration_s: float) -> float:
    """The same with the law computed once a tick, and held over it."""
    return _rate(formation, TICK_S, delay_ticks, duration_s, held=True)


def _rate(formation: LinearFormation, step_s: float, delay_steps: int, duration_s: float, *, held: bool) -> float:
    damping, pins, gains = formation.damping(), formation.pins(), formation.gains
    n = len(damping)
    window = math.ceil(duration_s / step_s / WINDOWS)
    start = np.random.default_rng(1).standard_normal(n)
    # The mean hears nothing. Where it goes its own way, it is no matter of the delay.
    mean = float(np.ptp(damping) == 0.0 and np.ptp(pins) == 0.0)
    levels = np.empty(WINDOWS)
    _simulate(
        formation.laplacian, gains.k1, gains.k2, damping, pins, start, step_s, delay_steps, window, mean, held, levels
    )
    half = WINDOWS // 2
    return float((levels[-1] - levels[half - 1]) / ((WINDOWS - half) * window * step_s))


@jit
def _simulate(
    laplacian: FloatArray,
    k1: float,
    k2: float,
    damping: FloatArray,
    pins: FloatArray,
    start: FloatArray,
    step_s: float,
    delay_steps: int,
    window: int,
    mean: float,
    held: bool,
    levels: FloatArray,
) -> None:
    """Logarithm of the RMS of e' over each window, from a disturbance of e; what was said before it is 0.

    Args:
        mean: 1 to take the mean out, 0 to leave it.
        held: one exact step with the law held; else Runge-Kutta, what was said in between by Hermite's cubic.
    """
    n = len(start)
    e = start - mean * start.mean()
    v = np.zeros(n)
    slots = delay_steps + 1
    said, slope = np.zeros((slots, n)), np.zeros((slots, n))
    heard, between, later = np.zeros(n), np.zeros(n), np.zeros(n)
    grown, h = 0.0, step_s
    for w in range(len(levels)):
        energy = 0.0
        for i in range(window):
            step = w * window + i
            now, old, next_old = step % slots, (step - delay_steps) % slots, (step - delay_steps + 1) % slots
            for p in range(n):
                said[now, p] = k1 * e[p] + k2 * v[p]
            if step >= delay_steps:
                for p in range(n):
                    heard[p], later[p] = said[old, p], said[next_old, p]
                    between[p] = 0.5 * (heard[p] + later[p]) + 0.125 * h * (slope[old, p] - slope[next_old, p])
            for p in range(n):
                c1, c2, c4 = 0.0, 0.0, 0.0
                for q in range(n):
                    c1 -= laplacian[p, q] * heard[q]
                    c2 -= laplacian[p, q] * between[q]
                    c4 -= laplacian[p, q] * later[q]
                d, pin, e1, v1 = damping[p], pins[p], e[p], v[p]
                a1 = c1 - d * v1 - pin * e1
                slope[now, p] = k1 * v1 + k2 * a1
                if held:
                    e[p] = e1 + h * v1 + 0.5 * h * h * a1
                    v[p] = v1 + h * a1
                else:
                    e2, v2 = e1 + 0.5 * h * v1, v1 + 0.5 * h * a1
                    a2 = c2 - d * v2 - pin * e2
                    e3, v3 = e1 + 0.5 * h * v2, v1 + 0.5 * h * a2
                    a3 = c2 - d * v3 - pin * e3
                    e4, v4 = e1 + h * v3, v1 + h * a3
                    a4 = c4 - d * v4 - pin * e4
                    e[p] = e1 + h / 6.0 * (v1 + 2.0 * v2 + 2.0 * v3 + v4)
                    v[p] = v1 + h / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4)
                energy += v[p] * v[p] / (n * window)
        size = math.sqrt(energy + 1e-300)
        grown += math.log(size)
        levels[w] = grown
        e = (e - mean * e.mean()) / size
        v = (v - mean * v.mean()) / size
        said /= size
        slope /= size
