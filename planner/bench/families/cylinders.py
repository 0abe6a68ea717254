"""Cylinders and radars over fractal ground, gathered about the straight line: 5 of them to 40."""

import numpy as np

from planner.bench.draft import WALL_M, Draft
from planner.bench.land import fractal_m, level_pad_m, raster_terrain
from planner.bench.routes import clear_of_route, winding_m

SIZE_M = (36000.0, 24000.0, 4000.0)
THINGS = (5, 14, 22, 31, 40)
RADARS = 0.35
"""Part of the things that are radars."""
RELIEF_M = (400.0, 600.0, 800.0, 1000.0, 1200.0)


def cylinders(rng: np.random.Generator, waypoints: int, level: int) -> Draft:
    """`level` 0 to 4: more things and higher ground."""
    route = winding_m(rng, SIZE_M, waypoints, bends=2 + level // 2, sideways=rng.uniform(0.1, 0.25))
    things = THINGS[level]
    radars = round(RADARS * things)
    drawn = np.column_stack(
        [
            rng.uniform(5000.0, SIZE_M[0] - 5000.0, 6 * things),
            rng.normal(0.5 * SIZE_M[1], 0.14 * SIZE_M[1], 6 * things),
            rng.uniform(400.0, 1400.0, 6 * things),
            rng.uniform(1200.0, 4000.0, 6 * things),
        ]
    )
    spheres, pillars = np.round(drawn[:radars]), np.round(drawn[radars:])
    reach = np.round(rng.uniform(1200.0, 2600.0, radars))
    ground = level_pad_m(fractal_m(rng, SIZE_M, RELIEF_M[level]), SIZE_M, route[0])
    return Draft(
        size_m=SIZE_M,
        terrain=raster_terrain(ground),
        radars=np.column_stack([spheres[:, :2], np.round(0.5 * spheres[:, 3]), reach, reach]),
        obstacles=clear_of_route(pillars, route, WALL_M)[: things - radars],
        route_m=route,
        target_above_m=float(np.round(rng.uniform(200.0, 900.0))),
    )
