"""Ways through the plan view: cheapest routes on a coarse grid, one or more for each way round what stands there.

The grid knows heights only as what can be reached: climbing from the origin and descending to the target bound how high
a path can be anywhere, and what stands higher than that must be gone round.
"""

import numpy as np
import numpy.typing as npt
from scipy.sparse import csr_array
from scipy.sparse.csgraph import dijkstra

from missions.environment import ground_heights_m
from missions.environment.radars import CORE
from planner.cost.problem import PathProblem

FloatArray = npt.NDArray[np.float64]

CELLS = 3600
"""Nodes of the grid."""
LEAST_CELL_M = 100.0
BLOCKED = 60.0
"""What a kilometre through something solid costs: a route is found all the same, and its descent says why not."""
NEAR_WALL = 0.5
"""What a kilometre along a wall costs more."""
MOVES = ((1, 0), (0, 1), (1, 1), (1, -1), (2, 1), (1, 2), (2, -1), (1, -2))
"""Half of a node's neighbours."""
ROUGHNESS = 0.45
"""Spread of the random factors that lead later routes elsewhere, as a logarithm."""
WALL = 1.12
"""Half the thickness of a wall, in cells: no move of a knight, sqrt(5) cells, leaps over it unpunished."""
PATCHES = 7
"""Random factors along each side, interpolated in between."""


class RouteGrid:
    """The grid of one problem: makes routes from origin to target."""

    def __init__(self, problem: PathProblem) -> None:
        b = problem.bounds
        self._problem = problem
        width, height = b.x_max_m - b.x_min_m, b.y_max_m - b.y_min_m
        cell = max(np.sqrt(width * height / CELLS), LEAST_CELL_M)
        self._shape = (max(int(width / cell), 4) + 1, max(int(height / cell), 4) + 1)
        self._x = np.linspace(b.x_min_m, b.x_max_m, self._shape[0])
        self._y = np.linspace(b.y_min_m, b.y_max_m, self._shape[1])
        x, y = np.meshgrid(self._x, self._y, indexing="ij")
        self._cost = _cost(x, y, cell, problem)
        index = np.arange(x.size).reshape(self._shape)
        pairs = [(_cut(index, -i, -j), _cut(index, i, j)) for i, j in MOVES]
        self._from = np.concatenate([a.ravel() for a, _ in pairs])
        self._to = np.concatenate([b.ravel() for _, b in pairs])
        flat_x, flat_y = x.ravel(), y.ravel()
        self._length = np.hypot(flat_x[self._to] - flat_x[self._from], flat_y[self._to] - flat_y[self._from])
        self._ends = [
            int(index[np.argmin(np.abs(self._x - end[0])), np.argmin(np.abs(self._y - end[1]))])
            for end in (problem.origin_m, problem.target_m)
        ]

    def route(self, *, rng: np.random.Generator | None = None, wall_m: FloatArray | None = None) -> FloatArray:
        """(n, 2) points of the cheapest route from origin to target.

        Args:
            rng: with chance, the cheapest for costs that are randomly different.
            wall_m: (2, 2) ends of a wall not to pass.
        """
        cost = self._cost
        if rng is not None:
            cost = cost * np.exp(ROUGHNESS * self._patches(rng))
        if wall_m is not None:
            cost = cost.copy()
            cost[self._along(wall_m)] = BLOCKED
        flat = cost.ravel()
        weights = self._length * 0.5 * (flat[self._from] + flat[self._to])
        graph = csr_array((weights, (self._from, self._to)), shape=(flat.size, flat.size))
        start, end = self._ends
        _, before = dijkstra(graph, directed=False, indices=start, return_predecessors=True)  # type: ignore[call-overload]  # the stubs know no single start
        nodes = [end]
        while nodes[-1] != start:
            nodes.append(int(before[nodes[-1]]))
        i, j = np.unravel_index(nodes[::-1], self._shape)
        points = np.column_stack([self._x[i], self._y[j]])
        points[0], points[-1] = self._problem.origin_m[:2], self._problem.target_m[:2]
        return points

    def _along(self, wall_m: FloatArray) -> npt.NDArray[np.bool_]:
        """Nodes within a cell of a wall."""
        x, y = self._x[:, None] - wall_m[0, 0], self._y[None, :] - wall_m[0, 1]
        along = wall_m[1] - wall_m[0]
        t = np.clip((x * along[0] + y * along[1]) / max(float(along @ along), 1e-9), 0.0, 1.0)
        near: npt.NDArray[np.bool_] = np.hypot(x - t * along[0], y - t * along[1]) <= WALL * (self._x[1] - self._x[0])
        return near

    def _patches(self, rng: np.random.Generator) -> FloatArray:
        """Smooth standard normal noise over the grid."""
        knots = rng.normal(size=(PATCHES, PATCHES))
        for axis in range(2):
            place = np.linspace(0.0, PATCHES - 1.0, self._shape[axis])
            low = np.minimum(place.astype(int), PATCHES - 2)
            part = np.expand_dims(place - low, 1)
            knots = (1.0 - part) * knots[low] + part * knots[low + 1]
            knots = knots.T
        smooth: FloatArray = knots
        return smooth


def _cut(index: npt.NDArray[np.int64], i: int, j: int) -> npt.NDArray[np.int64]:
    """Nodes that have a neighbour so many steps back along each axis (forth where negative)."""
    rows = slice(max(i, 0), len(index) + min(i, 0))
    columns = slice(max(j, 0), index.shape[1] + min(j, 0))
    return index[rows, columns]


def nominal_heights_m(x: FloatArray, y: FloatArray, problem: PathProblem) -> tuple[FloatArray, FloatArray]:
    """How high an even climb would be at each place, and how high the highest path could be."""
    b, origin, target = problem.bounds, problem.origin_m, problem.target_m
    gone, left = np.hypot(x - origin[0], y - origin[1]), np.hypot(x - target[0], y - target[1])
    highest = np.minimum(b.z_max_m, np.minimum(origin[2] + b.slope_max * gone, target[2] - b.slope_min * left))
    even = origin[2] + (target[2] - origin[2]) * gone / np.maximum(gone + left, 1.0)
    return np.minimum(even, highest), highest


def _cost(x: FloatArray, y: FloatArray, cell_m: float, problem: PathProblem) -> FloatArray:
    """Cost of a kilometre at each node."""
    b = problem.bounds
    even, highest = nominal_heights_m(x, y, problem)
    gone = np.hypot(x - problem.origin_m[0], y - problem.origin_m[1])
    ground = ground_heights_m(x, y, problem.terrain)
    low = ground + b.clearance_m * np.minimum(1.0, gone / b.climb_out_m)
    cost = np.ones_like(x)
    cost[(low > highest + 1.0) & (gone > cell_m)] = BLOCKED
    above = np.minimum(np.maximum(even, low), np.maximum(highest, low))
    # What little there is of air costs as in (5).
    cost += b.terrain_constant_km2 / 1000.0 / np.maximum(highest - ground, 50.0)
    for centre_x, centre_y, centre_z, radius, delta in problem.radars:
        distance = np.sqrt((x - centre_x) ** 2 + (y - centre_y) ** 2 + (above - centre_z) ** 2)
        density = (delta / np.maximum(distance, CORE * radius)) ** 4
        cost += np.where(distance < radius + 0.3 * cell_m, np.minimum(density, BLOCKED), 0.0)
    for centre_x, centre_y, radius, top, keep in problem.obstacles:
        beside = np.hypot(x - centre_x, y - centre_y) - radius
        tall = top + keep > highest
        cost[tall & (beside < keep + cell_m)] += NEAR_WALL
        cost[tall & (beside < keep)] = BLOCKED
        cost[~tall & (beside < keep)] += np.maximum(0.0, top + keep - above)[~tall & (beside < keep)] / 1000.0
    return cost
