"""Simulated time is an integer tick (MODEL, section 7)."""

import math

TICK_S = 0.04


def delay_ticks(delay_s: float) -> int:
    """A delay in whole ticks: rounded up, at least one."""
    return max(1, math.ceil(delay_s / TICK_S - 1e-9))
