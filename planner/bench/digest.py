"""A name for the content of a problem, which best-known values hang on: another problem, another name."""

import hashlib

import numpy as np

from planner.cost.problem import PathProblem


def problem_digest(problem: PathProblem, waypoints: int) -> str:
    """16 hexadecimal digits of a problem with so many interior waypoints, whatever the machine.

    Over all that the objective depends on, rounded to single precision: what two mathematics libraries make of one
    sine must not be two problems.
    """
    terrain = problem.terrain
    digest = hashlib.sha256()
    for part in (
        [waypoints],
        problem.origin_m,
        problem.target_m,
        [terrain.base_m, *terrain.wave],
        terrain.peaks,
        [terrain.x0_m, terrain.y0_m, terrain.spacing_x_m, terrain.spacing_y_m] if len(terrain.posts) else [],
        terrain.posts,
        problem.radars,
        problem.obstacles,
        problem.others,
        problem.separations_m,
        problem.bounds,
    ):
        values = np.asarray(part, dtype=np.float64)
        rounded = values.astype("<f4") + np.float32(0.0)  # no negative zeros
        digest.update(repr(values.shape if values.size else ()).encode() + rounded.tobytes())
    return digest.hexdigest()[:16]
