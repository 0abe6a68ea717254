"""A generated problem before it is one: surroundings drawn around a hidden route, which stays the proof that there is
a way."""

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from missions.environment import Terrain, ground_heights_m
from planner.cost.problem import Bounds, PathProblem

FloatArray = npt.NDArray[np.float64]

CLEARANCE_M = 130.0
"""Above ground, and beyond walls `WALL_M`: the shipped scenarios' limits of 100 m and the planner's margins."""
WALL_M = 145.0
CLIMB_OUT_M = 2000.0
SLOPE = 0.138
ROUTE_SLOPE = 0.11
"""Of a hidden route: fillets make legs steeper than corners say."""
ROUTE_CLIMB_OUT = 0.07
"""Slope of a route's first climb, just steeper than the wanted clearance grows."""
BOUNDS = Bounds(
    x_min_m=0.0,
    x_max_m=0.0,
    y_min_m=0.0,
    y_max_m=0.0,
    z_min_m=0.0,
    z_max_m=4000.0,
    leg_min_m=300.0,
    leg_max_m=8000.0,
    turn_max=np.radians(59.9),
    slope_min=-SLOPE,
    slope_max=SLOPE,
    clearance_m=CLEARANCE_M,
    climb_out_m=CLIMB_OUT_M,
    length_min_m=0.0,
    fillet_radius_m=253.0,
    collision_penalty_km=100.0,
    terrain_penalty_km=100.0,
    terrain_constant_km2=1.0,
)
"""Those of the shipped scenarios, with the planner's margins; the area's sides are each problem's own."""
GROUND_STEP_M = 25.0


class Draft(NamedTuple):
    """What a family draws.

    Attributes:
        size_m: x, y and z of the area, which begins at 0.
        terrain: the ground.
        radars: (n, 5) as in `PathProblem`.
        obstacles: (n, 4) x, y, radius, top.
        route_m: (m, 2) corners of the hidden route, origin and target included.
        target_above_m: how far above what the route needs there the target lies.
    """

    size_m: tuple[float, float, float]
    terrain: Terrain
    radars: FloatArray
    obstacles: FloatArray
    route_m: FloatArray
    target_above_m: float


def problem_of(draft: Draft) -> tuple[PathProblem, FloatArray]:
    """The problem, and its hidden route as (m, 3) corners. Whether that is feasible is for the kernel to say."""
    x_m, y_m, z_m = draft.size_m
    terrain = draft.terrain.as_array()
    corners = np.column_stack([draft.route_m, np.round(_altitudes_m(draft, terrain), 1)])
    keep = np.full((len(draft.obstacles), 1), WALL_M)
    problem = PathProblem(
        origin_m=corners[0],
        target_m=corners[-1],
        terrain=terrain,
        radars=np.ascontiguousarray(draft.radars, dtype=np.float64).reshape(-1, 5),
        obstacles=np.hstack([np.reshape(draft.obstacles, (-1, 4)), keep]),
        others=np.empty((0, len(corners), 4)),
        separations_m=np.empty(0),
        bounds=BOUNDS._replace(x_max_m=x_m, y_max_m=y_m, z_max_m=z_m),
    )
    return problem, corners


def _altitudes_m(draft: Draft, terrain: Terrain) -> FloatArray:
    """(m,) altitudes of the route's corners: above the ground of both legs, then raised until no slope is too steep."""
    route = draft.route_m
    legs = np.hypot(*np.diff(route, axis=0).T)
    passed = np.concatenate([[0.0], np.cumsum(legs)])
    highest = []
    for p, q, length in zip(route, route[1:], legs, strict=False):
        x, y = np.linspace(p, q, int(length / GROUND_STEP_M) + 2).T
        highest.append(float(ground_heights_m(x, y, terrain).max()))
    ground = np.maximum([highest[0], *highest], [*highest, highest[-1]])
    began = np.concatenate([[0.0], passed[:-1]])
    needed = ground + np.where(began < CLIMB_OUT_M, ROUTE_CLIMB_OUT * passed, CLEARANCE_M + 10.0)
    needed[0] = float(ground_heights_m(route[:1, 0], route[:1, 1], terrain)[0])
    needed[-1] += draft.target_above_m
    raised: FloatArray = np.max(needed - ROUTE_SLOPE * np.abs(passed[:, None] - passed), axis=1)
    raised[0] = needed[0]
    return raised
