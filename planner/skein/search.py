"""Skein's own search for one path: starts in many homotopy classes, descent by exact gradients in each, and from the
best on to the classes beside it."""

import math
from collections.abc import Callable, Iterable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import partial

import numba
import numpy as np
import numpy.typing as npt

from planner.cost.kernel import INFEASIBLE_KM, path_costs
from planner.cost.problem import PathProblem
from planner.cost.radar import radar_integral_m
from planner.skein.descent import polish
from planner.skein.merit import limits_count
from planner.skein.routes import RouteGrid
from planner.skein.sides import classes, on_other_sides, threats
from planner.skein.starts import bent_paths, jumped_paths, routed_paths
from planner.skein.tightened import tightened

FloatArray = npt.NDArray[np.float64]

BENDS, ROUTES, SPACINGS = 100, 6, 2
"""Starts that are looked at; each costs one evaluation."""
DESCENTS = 8
"""Starts that are followed, one a class."""


@dataclass(frozen=True)
class Stage:
    """How far descents are followed before the better ones are chosen: rounds, steps, tolerance; and how many go on."""

    rounds: int
    steps: int
    tolerance_km: float
    survivors: int


STAGES = (Stage(3, 40, 1e-4, 6), Stage(3, 60, 1e-5, 3), Stage(3, 100, 1e-6, 1))
WHOLE = (Stage(3, 40, 1e-4, 3), Stage(5, 80, 1e-5, 1))
"""Of starts beside the best."""
INSISTENT = (Stage(16, 150, 1e-7, 1),)
"""From the best of only infeasible paths: its limits may leave a narrow way."""
WHOLE_DESCENT = 1500
"""Evaluations that a descent takes from start to end, about: a small budget follows fewer starts."""
SHARE_OF_STARTS = 10
"""No more than the budget over this is spent on looking at starts."""
LEAST_ALLOWANCE = 50
"""Evaluations below which a descent is not worth its beginning."""
JUMPS, OTHER_ROUTES = 5, 3
"""Starts of each round that follows, once nothing better lies beside the best path."""
FAINT = 0.3
"""A radar whose edge costs less than this, kilometres a kilometre, may be flown through from the start. Others are
crossed only where there is no other way, and from within; round their edge is cheaper than just inside."""
GAIN = 1e-4
"""What counts as better, relative."""
WEIGHT, SOFTNESS_M = 10.0, 50.0
"""Of limits in the first round, 1 / km, and of (6)."""


class OutOfBudgetError(Exception):
    """No evaluations are left."""


@dataclass(frozen=True)
class PathResult:
    """What the search found, named as scipy's `OptimizeResult` names it.

    Attributes:
        x: (3 waypoints,) interior waypoints of the best path, metres.
        fun: its cost, kilometres.
        nfev: evaluations.
        history: evaluations and best cost whenever something was tried.
    """

    x: FloatArray
    fun: float
    nfev: int
    history: tuple[tuple[int, float], ...]


@dataclass
class Descent:
    """One start on its way.

    Attributes:
        corners_m: (n + 1, 3) where it is.
        crossed: (radars,) which it may fly through.
        multipliers, weight, softness_m: of its merit.
        best_m, cost_km: the best path on the way and its exact cost.
    """

    corners_m: FloatArray
    crossed: npt.NDArray[np.bool_]
    multipliers: FloatArray
    weight: float
    softness_m: float
    best_m: FloatArray
    cost_km: float


class PathSearch:
    """The search of one problem: what it has found and what it has used.

    Args:
        problem: of one UAV.
        waypoints: interior ones.
        budget: evaluations at most; a gradient counts as several.
        seed: of all chance.
        threads: that follow descents.
        patience: rounds without gain before it ends.
        report: told evaluations and best cost whenever something was tried; may raise to stop.
    """

    def __init__(
        self,
        problem: PathProblem,
        waypoints: int,
        budget: int,
        seed: int,
        threads: int,
        patience: float,
        report: Callable[[int, float], None],
    ) -> None:
        self.problem = problem
        self.waypoints = waypoints
        self.budget = budget
        self.evaluations = 0
        self.history: list[tuple[int, float]] = []
        self._tightened = tightened(problem)
        self._limits = limits_count(waypoints + 1, problem)
        self._around = threats(problem)
        self._grid = RouteGrid(problem)
        self._rng = np.random.default_rng(seed)
        self._report = report
        self._patience = patience
        self._pool = ThreadPoolExecutor(threads)
        crossed = [
            (radar[4] / radar[3]) ** 4 < FAINT
            or any(math.dist(end, radar[:3]) < radar[3] for end in (problem.origin_m, problem.target_m))
            for radar in problem.radars
        ]
        self._crossed = np.array(crossed, dtype=np.bool_)
        self.best_m = np.linspace(problem.origin_m, problem.target_m, waypoints + 2)
        self.cost_km = math.inf

    def run(self) -> PathResult:
        """Search until nothing better is near, or the budget is used."""
        try:
            with self._pool:
                starts = self._starts()
                self._follow([self._descent(start) for start in starts], STAGES)
                if self.cost_km >= INFEASIBLE_KM:
                    self._follow([self._descent(start, through=True) for start in starts], STAGES)
                if self.cost_km >= INFEASIBLE_KM:
                    self._follow([self._descent(self.best_m), self._descent(self.best_m, through=True)], INSISTENT)
                while self._improve():
                    pass
                stale = 0
                while stale < self._patience:
                    stale = 0 if self._jump() else stale + 1
        except OutOfBudgetError:
            pass
        return PathResult(self.best_m[1:-1].ravel(), self.cost_km, self.evaluations, tuple(self.history))

    def _starts(self) -> list[FloatArray]:
        """The cheapest start of each class, the cheapest first."""
        paths = bent_paths(self.problem, self.waypoints, BENDS, self._rng)
        if len(self._around) or len(self.problem.terrain.posts):
            routed = routed_paths(self._grid, self.problem, self.waypoints, ROUTES, SPACINGS, self._rng)
            paths = np.concatenate([routed, paths])
        paths = paths[: max(1, self.budget // SHARE_OF_STARTS)]
        costs = path_costs(paths, self.problem)
        self._count(len(paths), paths[int(np.argmin(costs))], float(costs.min()))
        return [paths[i] for i in self._by_class(paths, costs)[: min(DESCENTS, max(2, self.budget // WHOLE_DESCENT))]]

    def _by_class(
        self, paths_m: Sequence[FloatArray] | FloatArray, costs_km: Sequence[float] | FloatArray
    ) -> list[int]:
        """Indices of paths: the best of each class, the best first, then the others."""
        named = classes(paths_m, self._around)
        seen: set[bytes] = set()
        first: list[int] = []
        later: list[int] = []
        for i in np.argsort(costs_km, kind="stable").tolist():
            (later if named[i] in seen else first).append(i)
            seen.add(named[i])
        return first + later

    def _descent(self, start_m: FloatArray, *, through: bool = False) -> Descent:
        crossed = self._crossed | through
        return Descent(start_m.copy(), crossed, np.zeros(self._limits), WEIGHT, SOFTNESS_M, start_m.copy(), math.inf)

    def _follow(self, descents: list[Descent], stages: Iterable[Stage]) -> None:
        """Follow descents stage by stage, each time the better ones."""
        for stage in stages:
            allowance = (self.budget - self.evaluations) // max(len(descents), 1)
            if allowance < LEAST_ALLOWANCE:
                raise OutOfBudgetError
            step = partial(self._step, stage=stage, allowance=allowance)
            for descent, used in zip(descents, self._pool.map(step, descents), strict=True):
                self._count(used, descent.best_m, descent.cost_km)
            order = self._by_class([d.corners_m for d in descents], [d.cost_km for d in descents])
            descents = [descents[i] for i in order[: stage.survivors]]

    def _step(self, descent: Descent, stage: Stage, allowance: int) -> int:
        """Follow one descent for a stage; returns the evaluations that took."""
        best = descent.corners_m.copy()
        cost, descent.weight, used = polish(
            descent.corners_m,
            self._tightened,
            self.problem,
            descent.crossed,
            descent.multipliers,
            descent.weight,
            descent.softness_m,
            stage.rounds,
            stage.steps,
            stage.tolerance_km,
            allowance,
            best,
        )
        descent.softness_m *= 0.5**stage.rounds
        if cost < descent.cost_km:
            descent.best_m, descent.cost_km = best, float(cost)
        return int(used)

    def _improve(self) -> bool:
        """Try the classes beside the best path; whether one is better."""
        before = self.cost_km
        starts = [
            self._descent(path)
            for path in on_other_sides(self.best_m, self.problem, self._around, self._grid, self._rng)
        ]
        through = np.array([self._crosses(radar) for radar in self.problem.radars], dtype=np.bool_)
        if through.any():
            again = self._descent(self.best_m)
            again.crossed = self._crossed | through
            starts.append(again)
        self._follow(starts, WHOLE)
        return self.cost_km < before * (1.0 - GAIN)

    def _jump(self) -> bool:
        """Leave the best path by jumps, and for other routes; whether something better was found."""
        before = self.cost_km
        jumps = list(jumped_paths(self.best_m, self.problem, JUMPS, self._rng))
        jumps += list(routed_paths(self._grid, self.problem, self.waypoints, OTHER_ROUTES, 1, self._rng, chance=True))
        self._follow([self._descent(path) for path in jumps], WHOLE)
        if self.cost_km < before * (1.0 - GAIN):
            while self._improve():
                pass
            return True
        return False

    def _crosses(self, radar: FloatArray) -> bool:
        legs = zip(self.best_m[:-1], self.best_m[1:], strict=True)
        return any(radar_integral_m(p, q, radar) > 0.0 for p, q in legs)

    def _count(self, used: int, path_m: FloatArray, cost_km: float) -> None:
        self.evaluations += used
        if cost_km < self.cost_km:
            self.best_m, self.cost_km = path_m.copy(), cost_km
        self.history.append((self.evaluations, self.cost_km))
        self._report(self.evaluations, self.cost_km)


def skein_path(
    problem: PathProblem,
    waypoints: int,
    *,
    budget: int,
    seed: int,
    report: Callable[[int, float], None],
    threads: int | None = None,
    patience: float = 1,
) -> PathResult:
    """Search for the best path of one UAV.

    Args:
        problem: what it must mind.
        waypoints: interior ones.
        budget: evaluations of the objective at most; a gradient counts as `planner.skein.descent.GRADIENT`.
        seed: of all chance; with the budget it decides the result, whatever the number of threads.
        threads: that follow descents; as many as numba uses unless given.
        patience: rounds of new starts without gain before it ends; infinite to use the whole budget.
        report: told of evaluations used and the best cost, km, whenever something was tried; may raise to stop.
    """
    return PathSearch(problem, waypoints, budget, seed, threads or numba.get_num_threads(), patience, report).run()
