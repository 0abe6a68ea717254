"""The delay margin in continuous time, without actuators (MODEL, section 6, Delay margin)."""

import math

import numpy as np

from sitl.formation.crossing import NEVER, Array, Complex, Crossing, first_crossing
from sitl.formation.law import Gains
from sitl.formation.linear_formation import Mode

FREQUENCIES = np.geomspace(1e-5, 1.0, 200)
"""Where crossings are looked for when modes do not separate, in shares of the frequency that none is above."""


def continuous_margin(mode: Mode, gains: Gains) -> Crossing:
    """Where delay ends the stability of a mode: closed form of an eigenvalue, a sweep of a whole formation."""
    if gains.k1 == gains.k2 == 0.0:
        return NEVER
    if mode.eigenvalue is not None:
        return _closed_form(mode.eigenvalue, gains._replace(k3=float(mode.damping[0]), k0=float(mode.pins[0])))

    def transfer(w: Array) -> Complex:
        s: Complex = 1j * w[:, None].astype(np.complex128)
        return (gains.k1 + gains.k2 * s) / (s * s + mode.damping * s + mode.pins)

    largest = float(np.linalg.eigvalsh(mode.block)[-1])
    # Above this |mu| < 1: lambda (k1 + k2 w) < w^2 - k0.
    highest = 3.0 * (largest * gains.k2 + math.sqrt(largest * gains.k1) + math.sqrt(mode.pins.max()))
    return first_crossing(mode.block, transfer, FREQUENCIES * highest)


def _closed_form(eigenvalue: float, gains: Gains) -> Crossing:
    """Of s^2 + k3 s + k0 + lambda (k2 s + k1) e^{-s tau} = 0.

    With W = w^2 a positive root of W^2 + (k3^2 - 2 k0 - lambda^2 k2^2) W + k0^2 - lambda^2 k1^2 = 0,
    tau = [(atan2(k2 w, k1) + atan2(k3 w, w^2 - k0)) mod 2 pi] / w, the smallest over the roots.
    """
    k1, k2, k3, k0 = gains
    b = k3 * k3 - 2.0 * k0 - (eigenvalue * k2) ** 2
    c = k0 * k0 - (eigenvalue * k1) ** 2
    if b * b < 4.0 * c:
        return NEVER
    # The larger root of the two by size first: the other one from their product, without cancellation.
    far = -0.5 * (b + math.copysign(math.sqrt(b * b - 4.0 * c), b))
    first = NEVER
    for W in (far, c / far if far else 0.0):
        if W > 0.0:
            w = math.sqrt(W)
            angle = math.atan2(k2 * w, k1) + math.atan2(k3 * w, W - k0)
            delay = (angle % (2.0 * math.pi)) / w
            if delay < first.delay_s:
                first = Crossing(delay, w, np.ones(1))
    return first
