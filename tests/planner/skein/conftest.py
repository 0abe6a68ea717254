"""Problems with a bit of everything, for what sees a whole problem."""

import math
from collections.abc import Callable

import numpy as np
import numpy.typing as npt
import pytest

from missions.environment import Terrain, ground_height_m
from missions.environment.terrain import NO_WAVE
from planner.cost.problem import Bounds, PathProblem

FloatArray = npt.NDArray[np.float64]

BOUNDS = Bounds(
    x_min_m=-1000.0,
    x_max_m=21000.0,
    y_min_m=-10000.0,
    y_max_m=10000.0,
    z_min_m=0.0,
    z_max_m=3000.0,
    leg_min_m=300.0,
    leg_max_m=8000.0,
    turn_max=math.radians(60.0),
    slope_min=-0.14,
    slope_max=0.14,
    clearance_m=100.0,
    climb_out_m=2000.0,
    length_min_m=0.0,
    fillet_radius_m=250.0,
    collision_penalty_km=100.0,
    terrain_penalty_km=80.0,
    terrain_constant_km2=1.0,
)
LEGS = 6

MakeProblem = Callable[..., PathProblem]
DrawProblem = Callable[[np.random.Generator], tuple[PathProblem, FloatArray]]


def _problem(
    *,
    terrain: Terrain | None = None,
    radars: object = (),
    obstacles: object = (),
    others: object = (),
    origin: tuple[float, float] = (0.0, 0.0),
    target: tuple[float, float, float] = (20000.0, 0.0, 1000.0),
    **bounds: float,
) -> PathProblem:
    ground = terrain or Terrain(0.0, NO_WAVE, []).as_array()
    other_paths = np.array(others, dtype=np.float64)
    return PathProblem(
        origin_m=np.array([*origin, ground_height_m(*origin, ground)]),
        target_m=np.array(target),
        terrain=ground,
        radars=np.array(radars, dtype=np.float64).reshape(-1, 5),
        obstacles=np.array(obstacles, dtype=np.float64).reshape(-1, 5),
        others=other_paths if len(other_paths) else np.empty((0, 2, 4)),
        separations_m=np.full(len(other_paths), 300.0),
        bounds=BOUNDS._replace(**bounds),
    )


def _drawn_terrain(rng: np.random.Generator) -> Terrain:
    if rng.random() < 0.5:
        posts = 250.0 + 200.0 * np.add.outer(np.sin(np.arange(50) / 5.0), np.cos(np.arange(50) / 4.0))
        return Terrain(
            0.0, NO_WAVE, [], posts + rng.uniform(0.0, 60.0, (50, 50)), -500.0, -9000.0, 400.0, 380.0
        ).as_array()
    peaks = [
        (rng.uniform(-200.0, 900.0), rng.uniform(3e3, 17e3), rng.uniform(-3e3, 3e3), *rng.uniform(500.0, 3000.0, 2))
        for _ in range(3)
    ]
    return Terrain(10.0, NO_WAVE, peaks).as_array()


def _drawn(rng: np.random.Generator) -> tuple[PathProblem, FloatArray]:
    x, y = rng.uniform(3000.0, 17000.0, 6), rng.uniform(-3000.0, 3000.0, 6)
    radii = rng.uniform(500.0, 2500.0, 3)
    radars = [(x[i], y[i], rng.uniform(0, 1500), radii[i], radii[i] * rng.uniform(0.3, 1.0)) for i in range(3)]
    obstacles = [(x[i], y[i], rng.uniform(100, 900), rng.uniform(200, 1500), 145.0) for i in (3, 4, 5)]
    part = np.linspace(0.0, 1.0, LEGS + 1)
    others = [
        np.column_stack(
            [
                part * 20000,
                rng.uniform(-1500, 1500, LEGS + 1),
                part * 1000,
                np.sort([0, *rng.uniform(size=LEGS - 1), 1]),
            ]
        )
        for _ in range(2)
    ]
    problem = _problem(
        terrain=_drawn_terrain(rng),
        radars=radars,
        obstacles=obstacles,
        others=others,
        target=(20000.0, 500.0, 1200.0),
        leg_min_m=rng.choice([300.0, 3500.0]),
        leg_max_m=rng.choice([3000.0, 8000.0]),
        z_max_m=rng.choice([700.0, 3000.0]),
        y_max_m=rng.choice([500.0, 10000.0]),
        length_min_m=rng.choice([0.0, 30000.0]),
        fillet_radius_m=rng.choice([150.0, 1000.0]),
        clearance_m=rng.choice([100.0, 400.0]),
        climb_out_m=rng.choice([2000.0, 9000.0]),
    )
    wild = (500.0, 1200.0, 200.0) * rng.uniform(0.05, 1.0, 3)
    corners = problem.origin_m + part[:, None] * (problem.target_m - problem.origin_m)
    corners[1:-1] += rng.normal(size=(LEGS - 1, 3)) * wild
    return problem, corners


@pytest.fixture(scope="session")
def make_problem() -> MakeProblem:
    """A problem from (0, 0) on the ground to (20000, 0, 1000) over given things; keywords also change its bounds."""
    return _problem


@pytest.fixture(scope="session")
def draw_problem() -> DrawProblem:
    """A problem with peaks or a raster, radars, obstacles, other UAVs and tight or wide limits; and a path through it,
    (7, 3), from a bit off to wild."""
    return _drawn
