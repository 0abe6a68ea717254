"""Dryden gusts with fixed intensities and lengths, as an exact discrete filter.

The low-altitude form of MIL-F-8785C is singular on the ground; the values are those of R. Beard and T. McLain, "Small
Unmanned Aircraft: Theory and Practice", Princeton 2012, table 4.1, low altitude: L_u = L_v = 200 m, L_w = 50 m.
"""

import math
from typing import NamedTuple

NOMINAL_AIRSPEED_M_S = 28.0
"""One airspeed for all, so that gusts do not depend on the flight."""
LENGTH_ALONG_M = 200.0
LENGTH_ACROSS_M = 200.0
LENGTH_UP_M = 50.0
INTENSITIES_M_S = {"none": (0.0, 0.0), "light": (1.06, 0.7), "moderate": (2.12, 1.4)}
"""sigma_u = sigma_v, and sigma_w."""
NORMALS_PER_TICK = 5

Normals = tuple[float, ...]
"""`NORMALS_PER_TICK` standard normal draws."""


class GustState(NamedTuple):
    """Filter states: the longitudinal gust itself, and two states each for the lateral and the vertical one."""

    along: float
    across_1: float
    across_2: float
    up_1: float
    up_2: float


class SecondOrder(NamedTuple):
    """Exact discretisation of sigma sqrt(3 a) (s + a / sqrt 3) / (s + a)^2 driven by white noise.

    With z1 = noise / (s + a) and z2 = z1 / (s + a) the output is gain_1 z1 + gain_2 z2. `l11, l21, l22` is the
    Cholesky factor of the states' covariance gained in one tick, `start_*` that of the stationary state.
    """

    decay: float
    dt: float
    l11: float
    l21: float
    l22: float
    start_11: float
    start_21: float
    start_22: float
    gain_1: float
    gain_2: float


class GustFilter(NamedTuple):
    """The three filters of one aircraft."""

    along_decay: float
    along_noise: float
    along_sigma: float
    across: SecondOrder
    up: SecondOrder


def gust_filter(intensity: str, dt: float) -> GustFilter:
    """The filters for an intensity of `INTENSITIES_M_S` at a tick of dt seconds."""
    sigma_level, sigma_up = INTENSITIES_M_S[intensity]
    a = NOMINAL_AIRSPEED_M_S / LENGTH_ALONG_M
    return GustFilter(
        along_decay=math.exp(-a * dt),
        along_noise=sigma_level * math.sqrt(-math.expm1(-2.0 * a * dt)),
        along_sigma=sigma_level,
        across=_second_order(sigma_level, NOMINAL_AIRSPEED_M_S / LENGTH_ACROSS_M, dt),
        up=_second_order(sigma_up, NOMINAL_AIRSPEED_M_S / LENGTH_UP_M, dt),
    )


def _second_order(sigma: float, a: float, dt: float) -> SecondOrder:
    b = 2.0 * a
    e = math.exp(-b * dt)
    gained = ((1.0 - e) / b, (1.0 - e * (1.0 + b * dt)) / b**2, (2.0 - e * (2.0 + 2.0 * b * dt + (b * dt) ** 2)) / b**3)
    l11, l21, l22 = _cholesky(*gained)
    start_11, start_21, start_22 = _cholesky(1.0 / b, 1.0 / b**2, 2.0 / b**3)
    gain = sigma * math.sqrt(3.0 * a)
    return SecondOrder(
        decay=math.exp(-a * dt),
        dt=dt,
        l11=l11,
        l21=l21,
        l22=l22,
        start_11=start_11,
        start_21=start_21,
        start_22=start_22,
        gain_1=gain,
        gain_2=-gain * a * (1.0 - 1.0 / math.sqrt(3.0)),
    )


def _cholesky(q11: float, q12: float, q22: float) -> tuple[float, float, float]:
    l11 = math.sqrt(q11)
    l21 = q12 / l11
    return l11, l21, math.sqrt(max(q22 - l21 * l21, 0.0))


def start_gusts(normals: Normals, gusts: GustFilter) -> GustState:
    """A draw from the stationary distribution, so that the air is alive at the launch."""
    n0, n1, n2, n3, n4 = normals
    across, up = gusts.across, gusts.up
    return GustState(
        gusts.along_sigma * n0,
        across.start_11 * n1,
        across.start_21 * n1 + across.start_22 * n2,
        up.start_11 * n3,
        up.start_21 * n3 + up.start_22 * n4,
    )


def step_gusts(state: GustState, normals: Normals, gusts: GustFilter) -> GustState:
    """The filters' states one tick later.

    Args:
        normals: five independent standard normal draws.
    """
    n0, n1, n2, n3, n4 = normals
    across, up = gusts.across, gusts.up
    return GustState(
        gusts.along_decay * state.along + gusts.along_noise * n0,
        across.decay * state.across_1 + across.l11 * n1,
        across.decay * (state.across_2 + across.dt * state.across_1) + across.l21 * n1 + across.l22 * n2,
        up.decay * state.up_1 + up.l11 * n3,
        up.decay * (state.up_2 + up.dt * state.up_1) + up.l21 * n3 + up.l22 * n4,
    )


def wind_at(
    state: GustState, gusts: GustFilter, heading: float, steady: tuple[float, float]
) -> tuple[float, float, float]:
    """Steady wind plus gusts, (east, north, up) m/s. Gusts blow along and across the aircraft's heading."""
    along = state.along
    across = gusts.across.gain_1 * state.across_1 + gusts.across.gain_2 * state.across_2
    up = gusts.up.gain_1 * state.up_1 + gusts.up.gain_2 * state.up_2
    cos_heading = math.cos(heading)
    sin_heading = math.sin(heading)
    return (
        steady[0] + along * cos_heading - across * sin_heading,
        steady[1] + along * sin_heading + across * cos_heading,
        up,
    )
