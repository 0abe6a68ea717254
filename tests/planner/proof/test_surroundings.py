"""Distances from ground, walls and sides anywhere along random flights, against samples every centimetre or two."""

from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from missions.environment import ground_heights_m
from missions.environment.obstacles import wall_distances_m
from missions.environment.terrain import AIRBORNE_M
from missions.reference import Reference
from missions.scenario import Scenario
from missions.scenario.places import AreaModel, ObstacleModel, PeakModel, TerrainModel
from planner.proof.bracket import RESOLUTION_M, Least
from planner.proof.surroundings import circle_points, surroundings
from planner.proof.tracks import Tracks

MakeReferences = Callable[..., list[Reference]]
SAMPLE_M = 0.02


def around(scenario: Scenario, **changes: object) -> Scenario:
    """The scenario with other surroundings."""
    area = AreaModel(x_m=(-500.0, 4000.0), y_m=(-240.0, 240.0), z_m=(0.0, 340.0))
    given = {"obstacles": (), "radars": (), "area": area, **changes}
    return Scenario.model_validate({**{name: getattr(scenario, name) for name in type(scenario).model_fields}, **given})


def bracketed(least: Least, row: int, truth: float, cap: float = np.inf) -> None:
    """The proven bound is no more than the truth, and near it or at least as much as is enough."""
    assert least.low[row] <= truth + 1e-9
    assert least.low[row] >= min(truth, cap) - RESOLUTION_M - 10 * SAMPLE_M  # a needle's flank falls steeply


@settings(max_examples=25, deadline=None)
@given(
    seed=st.integers(0, 2**32),
    peaks=st.lists(
        st.tuples(st.floats(-100, 400), st.floats(0, 2800), st.floats(-200, 200), st.floats(1, 900)),
        min_size=1,
        max_size=4,
    ),
    towers=st.lists(st.tuples(st.floats(200, 2800), st.floats(-300, 300), st.floats(1, 100)), max_size=3),
)
def test_every_distance_is_bracketed(
    radars: Scenario,
    make_references: MakeReferences,
    seed: int,
    peaks: list[tuple[float, float, float, float]],
    towers: list[tuple[float, float, float]],
) -> None:
    terrain = TerrainModel(
        peaks=tuple(PeakModel(height_m=h, x_m=x, y_m=y, decline_x_m=d, decline_y_m=d) for h, x, y, d in peaks)
    )
    obstacles = tuple(ObstacleModel(x_m=x, y_m=y, radius_m=r, height_m=320.0) for x, y, r in towers)
    scenario = around(radars, terrain=terrain, obstacles=obstacles)
    references = make_references(seed, 2)
    found = surroundings(Tracks(references), references, scenario)
    environment, limits = scenario.environment, scenario.limits
    for row, reference in enumerate(references):
        s = np.linspace(0.0, reference.length_m, int(reference.length_m / SAMPLE_M))
        points = reference.points(s)
        above = points[:, 2] - ground_heights_m(points[:, 0], points[:, 1], environment.terrain)
        flying = s >= found.ground.airborne_m[row]
        if flying.any():
            wanted = limits.clearance_m * np.minimum(1.0, s / limits.climb_out_m)
            bracketed(found.ground.in_flight, row, float(above[flying].min()))
            bracketed(found.ground.spare, row, float((above - wanted)[flying].min()), cap=0.0)
        if found.ground.airborne_m[row] > 0.0:
            assert above[~flying][::250].max() < AIRBORNE_M + 1e-6  # looked for every 5 m
            bracketed(found.ground.on_ground, row, float(above[~flying].min()), cap=0.0)
        if obstacles:
            walls = np.min([wall_distances_m(points, obstacle) for obstacle in environment.obstacles], axis=0)
            bracketed(found.walls, row, float(walls.min()))
        area = environment.area
        low, high = np.array(area[::2]), np.array([*area[1:5:2], min(area.z_max_m, limits.altitude_max_m)])
        bracketed(found.room, row, float(np.minimum(points - low, high - points).min()), cap=0.0)
        radius = abs(reference.loiter_radius_m)
        round_m = np.linspace(0.0, 2 * np.pi * radius, int(2 * np.pi * radius / SAMPLE_M))
        x, y = circle_points(np.array(reference.target_m[:2]), np.full(len(round_m), radius), round_m).T
        heights = reference.loiter_z_m - ground_heights_m(x, y, environment.terrain)
        bracketed(found.loiters, row, float(heights.min()), cap=limits.clearance_m)


@settings(max_examples=25, deadline=None)
@given(seed=st.integers(0, 2**32), along=st.floats(0.1, 0.9), decline=st.floats(0.05, 4.0))
def test_a_needle_narrower_than_any_sampling_is_found(
    radars: Scenario, make_references: MakeReferences, seed: int, along: float, decline: float
) -> None:
    (reference,) = make_references(seed, 1)
    x, y, z = reference.points(np.array(along * reference.length_m)).tolist()
    needle = PeakModel(height_m=z + 20.0, x_m=x, y_m=y, decline_x_m=decline, decline_y_m=decline)
    scenario = around(radars, terrain=TerrainModel(peaks=(needle,)))
    found = surroundings(Tracks([reference]), [reference], scenario)
    assert found.ground.in_flight.low[0] == pytest.approx(-20.0, abs=RESOLUTION_M + 1e-6)
    assert found.ground.spare.at[0] == pytest.approx(along * reference.length_m, abs=4 * decline)


def test_without_obstacles_the_walls_are_infinitely_far(radars: Scenario, make_references: MakeReferences) -> None:
    references = make_references(0, 2)
    assert surroundings(Tracks(references), references, around(radars)).walls.low.tolist() == [np.inf, np.inf]
