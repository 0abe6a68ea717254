"""A problem a little tighter than the real one: what a descent finds on its limits then keeps the real ones."""

import numpy as np

from missions.environment import ground_height_m
from missions.environment.obstacles import Obstacle, wall_distances_m
from planner.cost.problem import PathProblem

TIGHTER_M = 0.5
"""Of every distance; millimetres of path."""
TIGHTER = 1e-3
"""Of every radius, relative; of turns in radians."""
TIGHTER_SLOPES = 3e-3
"""Of slopes, relative: on a leg of 300 m that is centimetres of height."""
ENDS_M = 1e-3
"""What is left at origin and target, where these stand closer than the tightened distance."""


def tightened(problem: PathProblem) -> PathProblem:
    """The problem that a descent sees."""
    b = problem.bounds
    ends = np.array([problem.origin_m, problem.target_m])
    obstacles = problem.obstacles.copy()
    for row in obstacles:
        at_ends = float(wall_distances_m(ends, Obstacle(*row[:4])).min())
        row[4] = max(row[4], min(row[4] + TIGHTER_M, at_ends - ENDS_M))
    others_at_ends = np.array(
        [
            min(np.linalg.norm(other[0, :3] - ends[0]), np.linalg.norm(other[-1, :3] - ends[1]))
            for other in problem.others
        ]
    ).reshape(-1)
    separations = np.maximum(
        problem.separations_m, np.minimum(problem.separations_m + TIGHTER_M, others_at_ends - ENDS_M)
    )
    at_target = problem.target_m[2] - ground_height_m(problem.target_m[0], problem.target_m[1], problem.terrain)
    bounds = b._replace(
        x_min_m=b.x_min_m + TIGHTER_M,
        x_max_m=b.x_max_m - TIGHTER_M,
        y_min_m=b.y_min_m + TIGHTER_M,
        y_max_m=b.y_max_m - TIGHTER_M,
        z_min_m=b.z_min_m + TIGHTER_M,
        z_max_m=b.z_max_m - TIGHTER_M,
        leg_min_m=b.leg_min_m + TIGHTER_M,
        leg_max_m=b.leg_max_m - TIGHTER_M,
        length_min_m=b.length_min_m + TIGHTER_M,
        turn_max=b.turn_max - TIGHTER,
        slope_min=b.slope_min * (1.0 - TIGHTER_SLOPES),
        slope_max=b.slope_max * (1.0 - TIGHTER_SLOPES),
        clearance_m=max(b.clearance_m, min(b.clearance_m + TIGHTER_M, at_target - ENDS_M)),
        fillet_radius_m=b.fillet_radius_m * (1.0 + TIGHTER),
    )
    radars = problem.radars.copy()
    radars[:, 3] += TIGHTER_M
    return problem._replace(radars=radars, obstacles=obstacles, separations_m=separations, bounds=bounds)
