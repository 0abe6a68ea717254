"""The searches that are compared, each as one that can be run on a problem.

**To add a method, add it to `METHODS`.** A black box sees a problem as `planner.search.waves` shows it; the planner's
own search sees the problem itself.
"""

from collections.abc import Callable

import numpy as np

from missions.errors import InputError
from planner.bench.problems import BenchProblem
from planner.bench.trace import Tracer
from planner.search.hybrid import hybrid
from planner.search.pso import pso
from planner.search.search import Search
from planner.search.waves import wave_view

Method = Callable[[BenchProblem, int, int, Tracer], None]
"""Searches a problem with a budget of evaluations and a seed, telling a tracer, which may raise `Stop`."""

REFERENCE = "skein"
"""The method that others are compared with where it takes part."""


def swarm(search: Search) -> Method:
    def run(problem: BenchProblem, budget: int, seed: int, tracer: Tracer) -> None:
        view = wave_view(problem.problem, problem.waypoints)
        rng = np.random.default_rng(seed)
        low, high = view.bounds.T
        search(
            tracer.counted(view),
            rng.uniform(low, high, (min(100, budget), len(low))),
            low,
            high,
            budget=budget,
            rng=rng,
            report=lambda *_: None,
        )

    return run


METHODS: dict[str, Method] = {"pso": swarm(pso), "hybrid": swarm(hybrid)}


def method_names(chosen: str) -> tuple[str, ...]:
    """Names from a list with commas, or `all`. Raises InputError."""
    names = tuple(dict.fromkeys(filter(None, chosen.split(",")))) if chosen != "all" else tuple(METHODS)
    for name in names:
        if name not in METHODS:
            raise InputError(f"method {name}: must be of {', '.join(METHODS)}")
    if not names:
        raise InputError("--methods: names no method")
    return names
