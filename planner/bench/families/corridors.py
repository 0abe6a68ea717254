"""Long narrow areas, up to 110 km, with cylinders that hug a winding way on both sides and radars beside it."""

import numpy as np

from planner.bench.draft import WALL_M, Draft
from planner.bench.land import flat_terrain
from planner.bench.routes import along_m, clear_of_route, winding_m

WIDTH_M, HEIGHT_M = 9000.0, 3000.0
LEG_M, LENGTH_MAX_M = 5200.0, 110000.0
CYLINDERS = (6, 10, 14, 18, 24)
ROOM_M = 700.0, 600.0, 500.0, 400.0, 300.0
"""Most that a cylinder leaves a route beside what must be kept from it."""


def corridors(rng: np.random.Generator, waypoints: int, level: int) -> Draft:
    """`level` 0 to 4: more cylinders, which leave less room."""
    length = min(LENGTH_MAX_M, LEG_M * (waypoints + 1))
    size = (length, WIDTH_M, HEIGHT_M)
    route = winding_m(rng, size, waypoints, bends=min(2 + level, waypoints // 2), sideways=0.22)
    count = CYLINDERS[level]
    x = np.linspace(5000.0, length - 5000.0, count) + rng.uniform(-800.0, 800.0, count)
    radius = rng.uniform(700.0, 1500.0, count)
    points = along_m(route)
    beside = radius + WALL_M + rng.uniform(80.0, ROOM_M[level], count)
    y = np.interp(x, points[:, 0], points[:, 1]) + rng.choice([-1.0, 1.0], count) * beside
    tops = np.where(rng.random(count) < 0.7, 4000.0, rng.uniform(800.0, 2000.0, count))
    drawn = np.round(np.column_stack([x, y, radius, tops]))
    radars = np.round(
        np.column_stack(
            [
                rng.uniform(8000.0, length - 5000.0, level + 1),
                rng.uniform(2000.0, WIDTH_M - 2000.0, level + 1),
                rng.uniform(300.0, 2000.0, level + 1),
                rng.uniform(1000.0, 2000.0, level + 1),
            ]
        )
    )
    return Draft(
        size_m=size,
        terrain=flat_terrain(),
        radars=np.column_stack([radars, radars[:, 3]]),
        obstacles=clear_of_route(drawn, route, WALL_M),
        route_m=route,
        target_above_m=float(np.round(rng.uniform(200.0, 900.0))),
    )
