"""What one core can do at most, measured by loops that do nothing else."""

import math
import time
from typing import Any

import numpy as np

from missions.compiled import jit

VALUES, ROUNDS, REPEATS = 1024, 400, 7
"""1024 numbers stay in the first cache."""
HORNER = 16
"""Flops a number of the polynomial, which the compiler does several numbers at a time."""


def peak_rates() -> dict[str, float]:
    """Operations a second by kind, as `planner.bench.count_work.KINDS` has them."""
    loops = {"flops": (_polynomials, HORNER), "sqrt": (_roots, 1), "exp": (_exponentials, 1), "atan": (_arctangents, 1)}
    rates = {}
    for kind, (loop, operations) in loops.items():
        values, results = np.linspace(0.01, 0.99, VALUES), np.empty(VALUES)
        loop(values, results, 1)
        times = []
        for _ in range(REPEATS):
            start = time.process_time()
            loop(values, results, ROUNDS)
            times.append(time.process_time() - start)
        rates[kind] = operations * VALUES * ROUNDS / min(times)
    return rates


@jit
def _polynomials(x: Any, y: Any, rounds: int) -> None:
    for r in range(rounds):
        for i in range(len(x)):
            v = x[i]
            a = 0.5 + r
            a = a * v + 0.25
            a = a * v + 0.5
            a = a * v + 0.75
            a = a * v + 0.25
            a = a * v + 0.5
            a = a * v + 0.75
            a = a * v + 0.25
            y[i] = a * v + 0.5


@jit
def _roots(x: Any, y: Any, rounds: int) -> None:
    for r in range(rounds):
        for i in range(len(x)):
            y[i] = math.sqrt(x[i] + r)


@jit
def _exponentials(x: Any, y: Any, rounds: int) -> None:
    for r in range(rounds):
        for i in range(len(x)):
            y[i] = math.exp(x[i] - r)


@jit
def _arctangents(x: Any, y: Any, rounds: int) -> None:
    for r in range(rounds):
        for i in range(len(x)):
            y[i] = math.atan(x[i] + r)
