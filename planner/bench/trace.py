"""What a search did: after how many evaluations and how much CPU time it had found what."""

import time
from collections.abc import Callable

import numpy as np
import numpy.typing as npt

from planner.cost.kernel import INFEASIBLE_KM
from planner.search.waves import WaveView

FloatArray = npt.NDArray[np.float64]

STEP = 5e-5
"""Smallest improvement of a cost, relative, that gets a line of its own."""


class Stop(Exception):  # noqa: N818
    """Ends a search that has had its evaluations or its time."""


class Tracer:
    """Counts evaluations, reads the CPU clock and keeps improvements; ends the search with `Stop`.

    Args:
        evaluations: that a search may use; None for as many as there is time for.
        cpu_s: CPU time of this process that it may use; None for as much as it takes.
        clock: of CPU time, in seconds.

    Attributes:
        lines: evaluations, CPU seconds and best feasible cost in kilometres after each improvement.
        path_m: interior waypoints, flat, of the best feasible path that was handed over; None without one.
        evaluations, cpu_s: used so far.
    """

    def __init__(
        self, evaluations: int | None, cpu_s: float | None, clock: Callable[[], float] = time.process_time
    ) -> None:
        self.lines: list[tuple[int, float, float]] = []
        self.path_m: FloatArray | None = None
        self.evaluations = 0
        self.cpu_s = 0.0
        self._evaluations_max, self._cpu_max_s, self._clock = evaluations, cpu_s, clock
        self._best = self._kept = self._path_km = np.inf
        self._before = 0
        self._start_s = clock()

    @property
    def remaining(self) -> float:
        """Part of the limit that is left, 0 to 1."""
        if self._cpu_max_s is not None:
            return max(0.0, 1.0 - (self._clock() - self._start_s) / self._cpu_max_s)
        assert self._evaluations_max is not None
        return max(0.0, 1.0 - self.evaluations / self._evaluations_max)

    def counted(self, view: WaveView) -> Callable[[FloatArray], FloatArray]:
        """A black box's cost function, (n, d) to (n,), that tells of every call."""

        def tell(x: FloatArray) -> FloatArray:
            costs = view.fun(x)
            leader = int(np.argmin(costs))
            self._tell(self.evaluations + len(x), float(costs[leader]))
            if costs[leader] < min(self._path_km, INFEASIBLE_KM):
                self.found(view.interiors(x[leader : leader + 1])[0], float(costs[leader]))
            return costs

        return tell

    def restarted(self) -> None:
        """What `report` counts from now on is a new search's."""
        self._before = self.evaluations

    def report(self, evaluations: int, cost_km: float) -> None:
        """For a search that counts itself: its evaluations so far and its best cost."""
        self._tell(self._before + evaluations, cost_km)

    def found(self, path_m: FloatArray, cost_km: float) -> None:
        """A feasible path, to keep if it is the best."""
        if cost_km < min(self._path_km, INFEASIBLE_KM):
            self.path_m, self._path_km = path_m.copy(), cost_km

    def finish(self) -> None:
        """The last line says what the search ended with."""
        if self._best < self._kept:
            self.lines.append((self.evaluations, self.cpu_s, self._best))
            self._kept = self._best

    def _tell(self, evaluations: int, cost_km: float) -> None:
        cpu_s = self._clock() - self._start_s
        late = self._cpu_max_s is not None and cpu_s > self._cpu_max_s
        many = self._evaluations_max is not None and evaluations > self._evaluations_max
        if late or many:
            raise Stop
        self.evaluations, self.cpu_s = evaluations, cpu_s
        if cost_km < min(self._best, INFEASIBLE_KM):
            self._best = cost_km
            if cost_km <= self._kept * (1.0 - STEP):
                self.lines.append((evaluations, cpu_s, cost_km))
                self._kept = cost_km
