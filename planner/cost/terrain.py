"""How high a leg passes above the ground.

Exactly, above a raster; above peaks and waves by samples so close that no dip between two of them is deeper than
`DIP_M`.
"""

import math
from typing import Any

from missions.compiled import compile_shared, jit
from missions.environment.terrain import analytic_height_m
from planner.cost.raster import least_height_above_raster_m

DIP_M = 5.0
SHORT_M = 1e-6

_analytic_height_m = compile_shared(analytic_height_m)


@jit
def leg_clearance_m(
    p: Any, q: Any, s0_m: float, s1_m: float, terrain: Any, clearance_m: float, climb_out_m: float
) -> tuple[float, float, float, float]:
    """Least clearance r_k of the leg from p to q, equation (6), and the largest shortfall of the wanted clearance.

    Args:
        s0_m, s1_m: length of the path before p and before q; the wanted clearance grows with it, from 0 at the
            origin to `clearance_m` at `climb_out_m`.

    Returns:
        r_k in metres and the part of the leg after which it is reached; the same of the shortfall, which is negative
        where there is more than wanted.
    """
    if len(terrain.posts) > 0:
        exact: tuple[float, float, float, float] = _above_raster_m(p, q, s0_m, s1_m, terrain, clearance_m, climb_out_m)
        return exact
    base_m, wave, peaks = terrain.base_m, terrain.wave, terrain.peaks
    steps = _steps(p, q, wave, peaks)
    # The ramp's end is a corner of what is wanted, which curvature knows nothing of: one sample more, right there, for
    # the shortfall; it moves along the leg, which a sample of the least clearance must not.
    ramp_end = (climb_out_m - s0_m) / max(s1_m - s0_m, SHORT_M)
    samples = steps + 2 if 0.0 < ramp_end < 1.0 else steps + 1
    least = math.inf
    shortfall = -math.inf
    lowest = shortest = 0.0
    for i in range(samples):
        t = i / steps if i <= steps else ramp_end
        x, y, z = p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1]), p[2] + t * (q[2] - p[2])
        clearance = z - _analytic_height_m(x, y, base_m, wave, peaks)
        wanted = clearance_m * min(1.0, (s0_m + t * (s1_m - s0_m)) / climb_out_m)
        if i <= steps and clearance < least:
            least, lowest = clearance, t
        if wanted - clearance > shortfall:
            shortfall, shortest = wanted - clearance, t
    return least, lowest, shortfall, shortest


@jit
def _above_raster_m(
    p: Any, q: Any, s0_m: float, s1_m: float, terrain: Any, clearance_m: float, climb_out_m: float
) -> tuple[float, float, float, float]:
    """`leg_clearance_m` above a raster.

    On the ramp the height above what is wanted there is that of a line lowered by it.
    """
    z0, z1 = p[2], q[2]
    if s0_m >= climb_out_m:
        least, lowest = least_height_above_raster_m(p, q, z0, z1, 0.0, 1.0, terrain)
        return least, lowest, clearance_m - least, lowest
    ramp_end = min(1.0, (climb_out_m - s0_m) / max(s1_m - s0_m, SHORT_M))
    wanted0, wanted1 = clearance_m * s0_m / climb_out_m, clearance_m * s1_m / climb_out_m
    least, lowest = least_height_above_raster_m(p, q, z0, z1, 0.0, ramp_end, terrain)
    over, shortest = least_height_above_raster_m(p, q, z0 - wanted0, z1 - wanted1, 0.0, ramp_end, terrain)
    if ramp_end < 1.0:
        beyond, place = least_height_above_raster_m(p, q, z0, z1, ramp_end, 1.0, terrain)
        if beyond < least:
            least, lowest = beyond, place
        if beyond - clearance_m < over:
            over, shortest = beyond - clearance_m, place
    return least, lowest, -over, shortest


@jit
def _steps(p: Any, q: Any, wave: Any, peaks: Any) -> int:
    """Into how many steps to cut a leg.

    Between two samples h apart a function dips by at most M h^2 / 8 below them, where M bounds its second derivative;
    the datum wave, which may have kinks, by at most L h / 2, where L bounds its slope.
    """
    bend = 0.0
    dx, dy = q[0] - p[0], q[1] - p[1]
    for i in range(len(peaks)):
        peak = peaks[i]
        u, v = (p[0] - peak[1]) / peak[3], (p[1] - peak[2]) / peak[4]
        du, dv = dx / peak[3], dy / peak[4]
        speed2 = du * du + dv * dv
        if speed2 == 0.0:
            continue
        t = min(1.0, max(0.0, -(u * du + v * dv) / speed2))
        u, v = u + t * du, v + t * dv
        exponent = u * u + v * v
        if exponent > 40.0:
            continue
        if peak[0] >= 0.0:
            bend += 2.0 * speed2 * peak[0] * math.exp(-exponent)
        else:  # the rim of a hollow
            rim = max(1.0, exponent)
            bend -= 4.0 * speed2 * peak[0] * rim * math.exp(-rim)
    steps = math.sqrt(bend / (8.0 * DIP_M))
    amplitude_m, _, b, c, d, e, f, g = wave
    if amplitude_m != 0.0:
        slope_km = abs(amplitude_m) * (1.0 + abs(b) + abs(c * d) + abs(e) + f * f + abs(g))
        rise_m = slope_km * math.hypot(dx, dy) / 1000.0 + abs(q[2] - p[2])
        steps = max(steps, rise_m / (2.0 * DIP_M))
    return int(steps) + 1
