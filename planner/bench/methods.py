"""The searches that are compared, each as one that can be run on a problem.

**To add a method, add it to `METHODS`.** A black box sees a problem as `planner.search.waves` shows it; the planner's
own search sees the problem itself.
"""

from collections.abc import Callable

import numpy as np

import planner.search.methods
from missions.errors import InputError
from planner.bench.problems import BenchProblem
from planner.bench.trace import Tracer
from planner.search import minimize
from planner.search.waves import wave_view
from planner.skein.search import skein_path

Method = Callable[[BenchProblem, int, int, Tracer], None]
"""Searches a problem with a budget of evaluations and a seed, telling a tracer, which may raise `Stop`."""

REFERENCE = "skein"
"""The method that others are compared with where it takes part."""


SKEIN = "skein"
BLACK_BOX = {SKEIN: "skein-blackbox"}
"""What a search of `planner.search.methods` is called here where another has its name."""


def black_box(method: str) -> Method:
    """A search that knows nothing of paths; it begins with the straight line."""

    def run(problem: BenchProblem, budget: int, seed: int, tracer: Tracer) -> None:
        view = wave_view(problem.problem, problem.waypoints)
        straight = np.zeros(len(view.bounds))
        minimize(tracer.counted(view), view.bounds, method=method, budget=budget, seed=seed, x0=straight)

    return run


def skein(problem: BenchProblem, budget: int, seed: int, tracer: Tracer) -> None:
    """The planner's own search."""
    found = skein_path(problem.problem, problem.waypoints, budget=budget, seed=seed, threads=1, report=tracer.report)
    tracer.found(found.x, found.fun)


METHODS: dict[str, Method] = {
    SKEIN: skein,
    **{BLACK_BOX.get(name, name): black_box(name) for name in planner.search.methods.METHODS},
}


def method_names(chosen: str) -> tuple[str, ...]:
    """Names from a list with commas, or `all`. Raises InputError."""
    names = tuple(dict.fromkeys(filter(None, chosen.split(",")))) if chosen != "all" else tuple(METHODS)
    for name in names:
        if name not in METHODS:
            raise InputError(f"method {name}: must be of {', '.join(METHODS)}")
    if not names:
        raise InputError("--methods: names no method")
    return names
