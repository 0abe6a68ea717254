"""The kernel against a plain numpy oracle that samples each leg densely, and against cases known by hand."""

import math
from itertools import pairwise
from typing import Any

import numba
import numpy as np
import numpy.typing as npt
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from missions.environment import Terrain, ground_heights_m
from missions.environment.terrain import NO_WAVE
from planner.cost.constraints import SLOPE_UNIT
from planner.cost.kernel import INFEASIBLE_KM, evaluate
from planner.cost.problem import Bounds, PathProblem
from planner.cost.terrain import DIP_M

FloatArray = npt.NDArray[np.float64]

SAMPLES = 4001

BOUNDS = Bounds(
    x_min_m=-1000.0,
    x_max_m=21000.0,
    y_min_m=-10000.0,
    y_max_m=10000.0,
    z_min_m=0.0,
    z_max_m=3000.0,
    leg_min_m=300.0,
    leg_max_m=12000.0,
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


def problem(
    *, peaks: Any = (), radars: Any = (), obstacles: Any = (), others: Any = (), target_z: float = 1000.0
) -> PathProblem:
    """From (0, 0, 0) to (20000, 0, target_z) over given things."""
    terrain = Terrain(0.0, NO_WAVE, list(peaks)).as_array()
    ground = ground_heights_m(np.array([0.0]), np.array([0.0]), terrain)
    return PathProblem(
        origin_m=np.array([0.0, 0.0, float(ground[0])]),
        target_m=np.array([20000.0, 0.0, target_z]),
        terrain=terrain,
        radars=np.array(radars, dtype=np.float64).reshape(-1, 5),
        obstacles=np.array(obstacles, dtype=np.float64).reshape(-1, 5),
        others=np.array(others, dtype=np.float64) if others else np.empty((0, 2, 4)),
        separations_m=np.full(len(others), 300.0),
        bounds=BOUNDS,
    )


def one(interior: Any, given_problem: PathProblem, reading: Any = "graded") -> tuple[float, FloatArray]:
    """Cost and terms of one path."""
    costs, terms = evaluate(np.array(interior, dtype=np.float64).reshape(1, -1), given_problem, reading)
    return float(costs[0]), terms[0]


def oracle(corners: FloatArray, p: PathProblem) -> tuple[FloatArray, float, bool]:
    """Terms of (3)-(11) without f_C, graded penalty of all that is wrong, and whether sampling can tell it at all."""
    b = p.bounds
    t = np.linspace(0.0, 1.0, SAMPLES)[:, None]
    legs = [start + t * (end - start) for start, end in pairwise(corners)]
    flat = np.diff(corners[:, :2], axis=0)
    across = np.hypot(flat[:, 0], flat[:, 1])
    headings = np.arctan2(flat[:, 1], flat[:, 0])
    turns = np.abs((np.diff(headings) + np.pi) % (2 * np.pi) - np.pi)
    tangents = b.fillet_radius_m * np.tan(turns / 2)
    room = across / np.where(np.isin(np.arange(len(across)), [0, len(across) - 1]), 1.0, 2.0)
    shortened = np.minimum(tangents, np.minimum(room[:-1], room[1:])) * (1 - turns / 2 / np.tan(turns / 2))
    arcs = across - np.append(shortened, 0.0) - np.append(0.0, shortened)
    passed = np.append(0.0, np.cumsum(arcs))

    lengths = np.linalg.norm(np.diff(corners, axis=0), axis=1)
    penalty, clear = 0.0, True

    def limit(over: float, most: float = math.inf, unsure: tuple[float, float] = (-1e-9, 1e-9)) -> None:
        nonlocal penalty, clear
        clear = clear and not unsure[0] < over < unsure[1]
        penalty += b.collision_penalty_km * (1.0 + min(over, most)) if over > 0 else 0.0

    for x, y, z in corners[1:-1]:
        outside = max(0, b.x_min_m - x, x - b.x_max_m) + max(0, b.y_min_m - y, y - b.y_max_m)
        outside += max(0, b.z_min_m - z, z - b.z_max_m)
        limit(outside / 1000.0 if outside else -1.0)
    for k, length in enumerate(lengths):
        slope = (corners[k + 1, 2] - corners[k, 2]) / arcs[k]
        for over in (1 - length / b.leg_min_m, length / b.leg_max_m - 1):
            limit(over)
        for over in ((slope - b.slope_max) / SLOPE_UNIT, (b.slope_min - slope) / SLOPE_UNIT):
            limit(over, most=10.0)
        if k < len(turns):
            limit(turns[k] / b.turn_max - 1)
            limit(tangents[k] / min(room[k], room[k + 1]) - 1, most=10.0)

    clearances, radar, ground_depth = [], 0.0, 0.0
    for k, (leg, length) in enumerate(zip(legs, lengths, strict=True)):
        above = leg[:, 2] - ground_heights_m(leg[:, 0], leg[:, 1], p.terrain)
        wanted = b.clearance_m * np.minimum(1.0, (passed[k] + t[:, 0] * arcs[k]) / b.climb_out_m)
        clearances.append(above.min())
        ground_depth += max(0.0, -above.min())
        clear = clear and not -2 * DIP_M < above.min() < 0.0
        short = float((wanted - above)[1:].max())  # the first sample of all stands on the ground
        limit(short / 1000.0, unsure=(0.0, 2 * DIP_M / 1000.0))
        for x, y, z, radius, delta in p.radars:
            distance = np.linalg.norm(leg - (x, y, z), axis=1)
            density = np.where(distance <= radius, (delta / np.maximum(distance, 0.1 * radius)) ** 4, 0.0)
            radar += float(np.mean((density[1:] + density[:-1]) / 2)) * length / 1000.0
        for x, y, radius, top, keep in p.obstacles:
            beside, over_top = np.hypot(leg[:, 0] - x, leg[:, 1] - y) - radius, leg[:, 2] - top
            outside_m = np.hypot(np.maximum(beside, 0), np.maximum(over_top, 0))
            short = keep - float(np.where(outside_m > 0, outside_m, np.maximum(beside, over_top)).min())
            limit(short / 1000.0, unsure=(-0.002, 0.002))
        progress = (passed[k] + t[:, 0] * arcs[k]) / passed[-1]
        for other, keep in zip(p.others, p.separations_m, strict=True):
            there = np.stack([np.interp(progress, other[:, 3], other[:, axis]) for axis in range(3)], axis=1)
            short = keep - float(np.linalg.norm(leg - there, axis=1).min())
            limit(short / 1000.0, unsure=(-0.002, 0.002))

    f_t = p.bounds.terrain_constant_km2 * 1000.0 / max(float(np.mean(clearances)), 1e-6)
    if ground_depth > 0.0:
        f_t = b.terrain_penalty_km * (1.0 + ground_depth / 1000.0)
    return np.array([lengths.sum() / 1000, f_t, radar, np.std(corners[:, 2], ddof=1) / 1000]), penalty, clear


def random_problem(rng: np.random.Generator) -> tuple[PathProblem, FloatArray]:
    """A problem with a bit of everything and a path through it, from a bit off to wild."""
    x = rng.uniform(3000, 17000, 8)
    y = rng.uniform(-3000, 3000, 8)
    peaks = [(rng.uniform(-200, 900), x[i], y[i], *rng.uniform(500, 3000, 2)) for i in range(2)]
    radii = rng.uniform(500, 2500, 2)
    radars = [(x[2 + i], y[2 + i], rng.uniform(0, 1500), radii[i], radii[i] * rng.uniform(0.3, 1)) for i in range(2)]
    obstacles = [(x[i], y[i], rng.uniform(100, 800), rng.uniform(200, 1500), 145.0) for i in (4, 5)]
    part = np.linspace(0, 1, 6)
    times = np.append(0.0, np.cumsum(rng.uniform(0.3, 1.0, 5)))  # nobody so fast that samples would miss it
    other = np.column_stack([part * 20000, rng.uniform(-1500, 1500, 6), part * 1000, times / times[-1]])
    p = problem(peaks=peaks, radars=radars, obstacles=obstacles, others=[other], target_z=1200.0)
    part = np.linspace(0, 1, 7)[1:-1, None]
    interior = p.origin_m + part * (p.target_m - p.origin_m) + rng.normal(size=(5, 3)) * (300, 800, 80) * rng.uniform()
    return p, interior


@settings(max_examples=60, deadline=None)
@given(seed=st.integers(0, 2**32))
def test_kernel_and_oracle_agree(seed: int) -> None:
    p, interior = random_problem(np.random.default_rng(seed))
    terms, penalty, clear = oracle(p.corners_m(interior), p)
    assume(clear)
    cost, found = one(interior, p)
    assert found[[0, 4]] == pytest.approx(terms[[0, 3]], rel=1e-9)
    assert found[2] == pytest.approx(terms[2], rel=2e-3, abs=5e-3)
    assert found[1] == pytest.approx(terms[1], rel=0.02, abs=80 * 6 * DIP_M / 1000)
    assert (cost < INFEASIBLE_KM) == (penalty == 0.0)
    if penalty:
        assert cost - INFEASIBLE_KM == pytest.approx(terms.sum() + penalty, rel=0.01, abs=5.0)
    else:
        assert cost == pytest.approx(terms.sum(), rel=2e-3)


@settings(max_examples=60, deadline=None)
@given(seed=st.integers(0, 2**32))
def test_readings_differ_only_where_something_is_wrong(seed: int) -> None:
    p, interior = random_problem(np.random.default_rng(seed))
    graded, published = one(interior, p), one(interior, p, "published")
    if graded[0] < INFEASIBLE_KM:
        assert graded[0] == published[0]
        assert np.array_equal(graded[1], published[1])
    else:
        assert graded[0] > published[0] > INFEASIBLE_KM


LEVEL = [[5000, 0, 300], [10000, 0, 500], [15000, 0, 750]]


def test_the_straight_path_costs_what_the_equations_say() -> None:
    cost, terms = one(LEVEL, problem())
    z = np.array([0, 0.3, 0.5, 0.75, 1.0])
    legs = np.hypot(5.0, np.diff(z)).sum()
    assert terms == pytest.approx([legs, 4 / (0 + 0.3 + 0.5 + 0.75), 0.0, 0.0, np.std(z, ddof=1)])
    assert cost == pytest.approx(terms.sum())


def test_a_leg_cannot_jump_across_a_radar() -> None:
    _, terms = one(LEVEL, problem(radars=[(7500, 400, 400, 600, 600)]))
    assert terms[2] > 1.0


def test_a_radar_is_a_cost_and_no_wall() -> None:
    cost, terms = one(LEVEL, problem(radars=[(7500, 0, 400, 600, 600)]))
    assert terms[2] > 100.0
    assert cost < INFEASIBLE_KM


def test_a_leg_cannot_jump_across_an_obstacle() -> None:
    p = problem(obstacles=[(12500, 100, 50, 2000, 100)])
    cost, terms = one(LEVEL, p, "published")
    assert cost > INFEASIBLE_KM
    assert terms[3] == BOUNDS.collision_penalty_km


def test_a_thin_peak_between_waypoints_is_seen() -> None:
    peak = (1000, 12500, 0, 60, 60)
    cost, terms = one(LEVEL, problem(peaks=[peak]), "published")
    assert cost > INFEASIBLE_KM
    assert terms[1] == BOUNDS.terrain_penalty_km
    assert one(LEVEL, problem(peaks=[(1000, 12500, 400, 60, 60)]))[0] < INFEASIBLE_KM


def crossing(at: float) -> list[list[float]]:
    """Another UAV that crosses the middle of the way after the part `at` of the flight."""
    return [[10000, -8000, 500, 0], [10000, 0, 500, at], [10000, 8000, 500, 1]]


def test_crossing_at_the_same_time_is_a_conflict_and_at_another_is_not() -> None:
    meeting = one(LEVEL, problem(others=[crossing(0.5)]), "published")
    assert meeting[0] > INFEASIBLE_KM
    assert meeting[1][3] == 2 * BOUNDS.collision_penalty_km  # on both of the legs that meet there
    assert one(LEVEL, problem(others=[crossing(0.4)]))[0] < INFEASIBLE_KM


@pytest.mark.parametrize(
    "interior",
    [
        [[5000, 0, 300], [10000, 0, 500], [10200, 0, 500]],  # leg too short
        [[1000, 0, 50], [1500, 0, 80], [2000, 0, 110]],  # leg too long
        [[5000, 5000, 300], [10000, -5000, 500], [15000, 5000, 750]],  # turns
        [[5000, 0, 300], [10000, 0, 1200], [15000, 0, 1100]],  # climbs
        [[5000, 0, 300], [10000, 0, 50], [15000, 0, 600]],  # too low
        [[5000, 0, 300], [10000, -10100, 500], [15000, 0, 750]],  # out of the area
    ],
)
def test_each_limit_makes_a_path_infeasible(interior: list[list[float]]) -> None:
    assert one(LEVEL, problem())[0] < INFEASIBLE_KM
    assert one(interior, problem())[0] > INFEASIBLE_KM


def test_feasible_ranks_before_infeasible_however_dear() -> None:
    dear, _ = one(LEVEL, problem(radars=[(7500, 0, 400, 600, 1e6)]))
    wrong, _ = one([[5000, 0, 300], [10000, 0, 1200], [15000, 0, 1100]], problem())
    assert one(LEVEL, problem())[0] < dear < wrong


def test_a_deeper_violation_costs_more() -> None:
    p = problem(obstacles=[(12500, 0, 500, 2000, 100)], peaks=[(900, 7500, 0, 800, 800)])
    sideways = [one([[5000, y, 300], [10000, y, 500], [15000, y, 750]], p)[0] for y in (0, 100, 200, 300)]
    assert sideways == sorted(sideways, reverse=True)


def test_one_thread_and_all_give_the_same_bits() -> None:
    rng = np.random.default_rng(5)
    p, interior = random_problem(rng)
    population = interior.ravel() + rng.normal(0, 300, (101, 15))
    threads = numba.get_num_threads()
    together = evaluate(population, p, "graded")
    numba.set_num_threads(1)
    try:
        alone = evaluate(population, p, "graded")
    finally:
        numba.set_num_threads(threads)
    assert np.array_equal(together[0], alone[0])
    assert np.array_equal(together[1], alone[1])


def test_peaks_and_a_fine_raster_of_them_cost_the_same() -> None:
    peaked = problem(peaks=[(700.0, 9000.0, 300.0, 2000.0, 1500.0), (-80.0, 4000.0, 0.0, 900.0, 900.0)])
    x, y = np.arange(-1000.0, 22000.0, 20.0), np.arange(-3000.0, 3001.0, 20.0)
    posts = ground_heights_m(*np.meshgrid(x, y), peaked.terrain)
    raster = peaked._replace(terrain=Terrain(0.0, NO_WAVE, [], posts, x[0], y[0], 20.0, 20.0).as_array())
    paths = np.linspace(peaked.origin_m, peaked.target_m, 6)[1:-1].ravel()
    paths = paths + np.random.default_rng(5).normal(size=(300, 12)) * np.tile([300.0, 300.0, 150.0], 4)
    paths[:, 2::3] += 200.0
    for reading in ("graded", "published"):
        _, with_peaks = evaluate(paths, peaked, reading)
        _, with_raster = evaluate(paths, raster, reading)
        under = with_peaks[:, 1] >= BOUNDS.terrain_penalty_km
        assert 20 < under.sum() < 280
        assert np.array_equal(with_raster[:, [0, 2, 3, 4]], with_peaks[:, [0, 2, 3, 4]])
        # Nearly all: a path that just touches the ground on one may clear it on the other.
        assert np.mean(np.isclose(with_raster[:, 1], with_peaks[:, 1], rtol=0.03)) > 0.97
