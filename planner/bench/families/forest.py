"""A forest of thin towers, a few of which can be flown over, on level ground."""

import numpy as np
import numpy.typing as npt

from planner.bench.draft import WALL_M, Draft
from planner.bench.land import flat_terrain
from planner.bench.routes import clear_of_route, winding_m

FloatArray = npt.NDArray[np.float64]

SIZE_M = (30000.0, 16000.0, 3000.0)
TOWERS = (12, 24, 36, 48, 60)


def forest(rng: np.random.Generator, waypoints: int, level: int) -> Draft:
    """`level` 0 to 4: denser and denser."""
    route = winding_m(rng, SIZE_M, waypoints, bends=1 + level, sideways=rng.uniform(0.05, 0.15))
    many = 3 * TOWERS[level]
    towers: FloatArray = np.column_stack(
        [
            rng.uniform(4500.0, SIZE_M[0] - 4500.0, many),
            rng.normal(0.5 * SIZE_M[1], 0.16 * SIZE_M[1], many),
            rng.uniform(150.0, 450.0, many),
            rng.uniform(800.0, 3600.0, many),
        ]
    ).round()
    return Draft(
        size_m=SIZE_M,
        terrain=flat_terrain(),
        radars=np.empty((0, 5)),
        obstacles=clear_of_route(towers, route, WALL_M)[: TOWERS[level]],
        route_m=route,
        target_above_m=float(np.round(rng.uniform(200.0, 900.0))),
    )
