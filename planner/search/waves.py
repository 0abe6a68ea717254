"""A path as sine waves about its straight line: numbers in which a random path is already near-sensible.

This is how a search that knows nothing of paths sees one: d = 3 m numbers in [-1, 1], of which 0 is the straight line
and any choice a smooth bend. The map is linear and, for m waypoints, reaches every path inside its amplitudes.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from planner.cost.kernel import Reading, evaluate
from planner.cost.problem import PathProblem

FloatArray = npt.NDArray[np.float64]

ALONG = 0.2
"""Largest first wave along the line, in lengths of the line."""
SIDEWAYS = 0.5
"""Largest first wave to its left, in lengths of the line."""
UPWARDS = 0.5
"""Largest first wave upwards, in heights of the area."""
DECAY = 1.5
"""The waves of a path with a corner fall with j^2, those of a random walk with j: between them, random paths are smooth
and corners within reach."""


@dataclass(frozen=True)
class WaveView:
    """A problem as a search sees it.

    Attributes:
        fun: (n, d) of numbers to (n,) costs in kilometres, `planner.cost.kernel.evaluate`.
        bounds: (d, 2), -1 and 1.
        interiors: (n, d) of numbers to (n, d) interior waypoints in metres.
        numbers: the inverse, for paths found by other means.
    """

    fun: Callable[[FloatArray], FloatArray]
    bounds: FloatArray
    interiors: Callable[[FloatArray], FloatArray]
    numbers: Callable[[FloatArray], FloatArray]


def wave_view(problem: PathProblem, waypoints: int, reading: Reading = "graded") -> WaveView:
    """The view of a problem with so many interior waypoints.

    Half wave j of m, j = 1..m, is sin(j pi part) / j^`DECAY` at the stations part = k / (m + 1).
    """
    part = np.linspace(0.0, 1.0, waypoints + 2)[1:-1]
    wave = np.arange(1, waypoints + 1)
    shapes = np.sin(np.pi * wave[:, None] * part) / wave[:, None] ** DECAY
    line = problem.target_m - problem.origin_m
    distance = float(np.hypot(line[0], line[1]))
    forward = line[:2] / distance
    axes = np.zeros((3, 3))
    axes[0, :2] = ALONG * distance * forward
    axes[1, :2] = SIDEWAYS * distance * np.array([-forward[1], forward[0]])
    axes[2, 2] = UPWARDS * (problem.bounds.z_max_m - problem.bounds.z_min_m)
    straight = problem.origin_m + part[:, None] * line
    back_shapes, back_axes = np.linalg.inv(shapes), np.linalg.inv(axes)

    def interiors(numbers: FloatArray) -> FloatArray:
        offsets = np.einsum("nja,jk->nka", numbers.reshape(len(numbers), waypoints, 3), shapes) @ axes
        flat: FloatArray = (straight + offsets).reshape(len(numbers), -1)
        return flat

    def numbers(interiors: FloatArray) -> FloatArray:
        offsets = (interiors.reshape(len(interiors), waypoints, 3) - straight) @ back_axes
        flat: FloatArray = np.einsum("nka,kj->nja", offsets, back_shapes).reshape(len(interiors), -1)
        return flat

    return WaveView(
        fun=lambda x: evaluate(interiors(x), problem, reading)[0],
        bounds=np.tile([-1.0, 1.0], (3 * waypoints, 1)),
        interiors=interiors,
        numbers=numbers,
    )
