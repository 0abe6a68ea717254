"""The searches that are compared, each as one that can be run on a problem.

**To add a method, add it to `METHODS`.** A black box sees a problem as `planner.search.waves` shows it; the planner's
own search, `skein`, sees the problem itself.
"""

import difflib
import math
from collections.abc import Callable
from functools import partial

import numpy as np

from missions.errors import InputError
from planner.bench.problems import BenchProblem
from planner.bench.trace import Tracer
from planner.search import minimize
from planner.search.methods import METHODS as BLACK_BOXES
from planner.search.waves import wave_view
from planner.skein.search import skein_path

Method = Callable[[BenchProblem, int, int, Tracer], None]
"""Searches a problem with a budget of evaluations and a seed, telling a tracer, which may raise `Stop`."""

REFERENCE = "skein"
"""The method that others are compared with where it takes part."""
BLACK = "-blackbox"
"""Ends the name of a black box whose own name is the reference's."""


def _skein(problem: BenchProblem, budget: int, seed: int, tracer: Tracer) -> None:
    result = skein_path(
        problem.problem,
        problem.waypoints,
        budget=budget,
        seed=seed,
        report=tracer.report,
        threads=1,
        patience=math.inf,
    )
    tracer.found(result.x, result.fun)


def _black_box(name: str, problem: BenchProblem, budget: int, seed: int, tracer: Tracer) -> None:
    view = wave_view(problem.problem, problem.waypoints)
    straight = np.zeros(len(view.bounds))
    minimize(tracer.counted(view), view.bounds, method=name, budget=budget, seed=seed, x0=straight)


METHODS: dict[str, Method] = {
    REFERENCE: _skein,
    **{name + BLACK * (name == REFERENCE): partial(_black_box, name) for name in BLACK_BOXES},
}


def method_names(chosen: str) -> tuple[str, ...]:
    """Names from a list with commas, or `all`.

    Raises:
        InputError: there is no such method, or it needs an extra that is not installed.
    """
    names = tuple(METHODS) if chosen == "all" else tuple(dict.fromkeys(filter(None, chosen.split(","))))
    for name in names:
        if name not in METHODS:
            near = difflib.get_close_matches(name, METHODS, n=1)
            raise InputError(
                f"method {name}: must be of {', '.join(METHODS)}{f'; did you mean {near[0]}?' if near else ''}"
            )
        if name != REFERENCE:  # says which extra is missing, before an hour of runs
            minimize(lambda x: x[:, 0], [(0.0, 1.0)], method=name.removesuffix(BLACK), budget=1, seed=0)
    if not names:
        raise InputError("--methods: names no method")
    return names
