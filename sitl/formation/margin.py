"""The delay margin: how late corrections may come before the formation rings (MODEL, section 6, Delay margin)."""

import math

import numpy as np
import numpy.typing as npt
from scipy.linalg import expm

from sitl.formation.law import Gains

FREQUENCIES_RAD_S = np.geomspace(1e-3, 1.0, 4000)
"""Where crossings are looked for, as shares of pi / tick."""


def continuous_margin_s(eigenvalue: float, gains: Gains) -> float:
    """Margin of one mode of the Laplacian, in continuous time without actuator lag; infinite when it has none.

    With W = w^2 a root of W^2 + (k3^2 - 2 k0 - lambda^2 k2^2) W + k0^2 - lambda^2 k1^2 = 0,
    tau = [(atan2(k2 w, k1) + atan2(k3 w, w^2 - k0)) mod 2 pi] / w, the smallest over the positive roots.
    """
    k1, k2, k3, k0 = gains
    b = k3**2 - 2.0 * k0 - (eigenvalue * k2) ** 2
    c = k0**2 - (eigenvalue * k1) ** 2
    roots = np.roots([1.0, b, c])
    margin = math.inf
    for root in roots:
        if abs(root.imag) < 1e-12 and root.real > 1e-12:
            w = math.sqrt(root.real)
            phase = math.atan2(k2 * w, k1) + math.atan2(k3 * w, w * w - k0)
            margin = min(margin, (phase % (2.0 * math.pi)) / w)
    return margin


def aircraft_margin_s(laplacian: npt.NDArray[np.float64], gains: Gains, thrust_lag_s: float, tick_s: float) -> float:
    """Margin of a formation of aircraft: with thrust lag, and with states held over a tick; infinite when it has none.

    Each mode lambda of the Laplacian is a loop of the sampled plant (double integrator behind the lag, own feedback k0
    and k3 closed) and the delayed lambda (k1 + k2 s). The margin is the delay that turns the loop's phase to -pi where
    its gain is one, the smallest over modes and crossings; a delay counts in whole ticks in flight.

    Args:
        laplacian: weighted, (n, n).
        thrust_lag_s: first-order; 0 for the sampled margin without lag.
    """
    return min(
        (_sampled_margin_s(mode, gains, thrust_lag_s, tick_s) for mode in np.linalg.eigvalsh(laplacian) if mode > 1e-9),
        default=math.inf,
    )


def _sampled_margin_s(eigenvalue: float, gains: Gains, thrust_lag_s: float, tick_s: float) -> float:
    plant, drive = _sampled_plant(thrust_lag_s, tick_s)
    own = np.zeros(len(plant))
    own[:2] = gains.k0, gains.k3
    heard = np.zeros(len(plant))
    heard[:2] = gains.k1, gains.k2
    if not heard.any():
        return math.inf
    closed = plant - np.outer(drive, own)
    if np.abs(np.linalg.eigvals(closed - eigenvalue * np.outer(drive, heard))).max() >= 1.0:
        return 0.0
    w = FREQUENCIES_RAD_S * math.pi / tick_s
    z = np.exp(1j * w * tick_s)
    resolvent = np.linalg.solve(z[:, None, None] * np.eye(len(plant)) - closed, drive[None, :, None])
    loop = eigenvalue * (resolvent[:, :, 0] @ heard)
    level = np.log(np.abs(loop))
    phase = np.unwrap(np.angle(loop))
    margin = math.inf
    for i in np.flatnonzero(np.sign(level[:-1]) != np.sign(level[1:])):
        share = level[i] / (level[i] - level[i + 1])
        w_cross = w[i] + share * (w[i + 1] - w[i])
        to_turn = math.pi + phase[i] + share * (phase[i + 1] - phase[i])
        margin = min(margin, (to_turn % (2.0 * math.pi)) / w_cross)
    return margin


def _sampled_plant(thrust_lag_s: float, tick_s: float) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]:
    """States (e, e', acceleration behind the lag) over one tick with the command held: matrix and input vector."""
    if thrust_lag_s == 0.0:
        return np.array([[1.0, tick_s], [0.0, 1.0]]), np.array([tick_s**2 / 2, tick_s])
    rates = np.zeros((4, 4))
    rates[0, 1] = rates[1, 2] = 1.0
    rates[2, 2:] = -1.0 / thrust_lag_s, 1.0 / thrust_lag_s
    step = expm(rates * tick_s)
    return step[:3, :3], step[:3, 3]
