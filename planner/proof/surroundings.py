"""How near all paths come to ground, walls and the area's sides anywhere along them, not only at samples."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from missions.environment import ground_heights_m
from missions.environment.obstacles import wall_distances_m
from missions.environment.terrain import AIRBORNE_M
from missions.reference import Reference
from missions.scenario import Scenario
from planner.proof.bracket import Least, between, both, even, least
from planner.proof.ground import ground_bounds
from planner.proof.tracks import Tracks

FloatArray = npt.NDArray[np.float64]
IntArray = npt.NDArray[np.int64]

WIDTH_M = 64.0
"""Of the first intervals."""
LOOK_M = 5.0
"""Between the points at which a climb-out is first looked at for where it becomes airborne."""
HALVINGS = 12
"""Of those, to a millimetre."""


@dataclass(frozen=True)
class Clearances:
    """Of each path, (n,), arc lengths `at`.

    Attributes:
        airborne_m: arc length from which it counts as airborne; the whole length where it never does.
        on_ground: height above ground before that.
        in_flight: height above ground from there on.
        spare: that, less what is wanted; what is wanted grows from 0 over limits.climb_out_m.
    """

    airborne_m: FloatArray
    on_ground: Least
    in_flight: Least
    spare: Least


@dataclass(frozen=True)
class Surroundings:
    """What is proven of all paths, (n,), `at` arc lengths.

    Attributes:
        ground: heights above it.
        walls: distance from the nearest obstacle's; infinite without obstacles.
        room: how far inside the area and below the highest altitude; negative outside.
        loiters: height above ground around the circles at the end.
    """

    ground: Clearances
    walls: Least
    room: Least
    loiters: Least


def surroundings(tracks: Tracks, references: Sequence[Reference], scenario: Scenario) -> Surroundings:
    """All of it; `references` are those of the tracks."""
    return Surroundings(
        clearances(tracks, scenario),
        walls(tracks, scenario),
        room(tracks, scenario),
        loiter_clearances(references, scenario),
    )


def clearances(tracks: Tracks, scenario: Scenario) -> Clearances:
    """Heights above ground of all paths."""
    terrain, limits = scenario.environment.terrain, scenario.limits

    def heights(row: IntArray, s_m: FloatArray) -> FloatArray:
        x, y, z = tracks.points(row, s_m).T
        height: FloatArray = z - ground_heights_m(x, y, terrain)
        return height

    def bounds(row: IntArray, a: FloatArray, b: FloatArray, ramp: float) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Of the height less a wanted one that rises by `ramp` a metre up to limits.clearance_m."""
        x, y, _ = tracks.points(row, (a + b) / 2).T
        ground, shape = ground_bounds(x, y, (b - a) / 2, terrain), tracks.shape(row, a, b)
        start, end = (heights(row, s_m) - np.minimum(limits.clearance_m, ramp * s_m) for s_m in (a, b))
        # A section of the ground along a curved path also bends by what the curve leans across the slope.
        bend = ground.bend + ground.slope * shape.curvature + shape.altitude_bend
        lower = between(start, end, b - a, ground.slope + shape.slope + ramp, bend)
        return lower, np.minimum(start, end), np.where(start <= end, a, b)

    zero, ramp = np.zeros(len(tracks)), limits.clearance_m / limits.climb_out_m
    airborne = _airborne_from_m(tracks, heights)
    ramp_end = np.clip(limits.climb_out_m, airborne, tracks.lengths_m)
    on_ground = even(zero, airborne, WIDTH_M)
    climbing, cruising = even(airborne, ramp_end, WIDTH_M), even(ramp_end, tracks.lengths_m, WIDTH_M)
    in_flight = both(climbing, cruising)
    rows = len(tracks)
    return Clearances(
        airborne,
        on_ground=least(rows, on_ground, lambda row, a, b: bounds(row, a, b, 0.0), 0.0),
        in_flight=least(rows, in_flight, lambda row, a, b: bounds(row, a, b, 0.0), np.inf),
        spare=least(rows, in_flight, lambda row, a, b: bounds(row, a, b, ramp), 0.0),
    )


def walls(tracks: Tracks, scenario: Scenario) -> Least:
    """Distance of each path from the nearest obstacle's wall; infinite without obstacles."""
    obstacles = scenario.environment.obstacles
    if not obstacles:
        return Least(*(np.full(len(tracks), value) for value in (np.inf, np.inf, 0.0)))

    def distances(row: IntArray, s_m: FloatArray) -> FloatArray:
        points = tracks.points(row, s_m)
        nearest: FloatArray = np.array([wall_distances_m(points, obstacle) for obstacle in obstacles]).min(axis=0)
        return nearest

    def bounds(row: IntArray, a: FloatArray, b: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        start, end = distances(row, a), distances(row, b)
        lower = np.maximum(0.0, between(start, end, b - a, tracks.shape(row, a, b).stretch, np.full(len(row), np.inf)))
        return lower, np.minimum(start, end), np.where(start <= end, a, b)

    return least(len(tracks), even(np.zeros(len(tracks)), tracks.lengths_m, WIDTH_M), bounds, np.inf)


def room(tracks: Tracks, scenario: Scenario) -> Least:
    """How far each path stays inside the sides of the area (1) and below the highest altitude; negative outside."""
    area = scenario.environment.area
    low = np.array([area.x_min_m, area.y_min_m, area.z_min_m])
    high = np.array([area.x_max_m, area.y_max_m, min(area.z_max_m, scenario.limits.altitude_max_m)])

    def inside(row: IntArray, s_m: FloatArray) -> FloatArray:
        points = tracks.points(row, s_m)
        least_of_sides: FloatArray = np.minimum(points - low, high - points).min(axis=1)
        return least_of_sides

    def bounds(row: IntArray, a: FloatArray, b: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        start, end, shape = inside(row, a), inside(row, b), tracks.shape(row, a, b)
        lower = between(start, end, b - a, shape.stretch, shape.bend)
        return lower, np.minimum(start, end), np.where(start <= end, a, b)

    return least(len(tracks), even(np.zeros(len(tracks)), tracks.lengths_m, WIDTH_M), bounds, 0.0)


def loiter_clearances(references: Sequence[Reference], scenario: Scenario) -> Least:
    """Height above ground around the circle at each path's end, `at` arc lengths anticlockwise from its east."""
    terrain = scenario.environment.terrain
    radius = np.array([abs(reference.loiter_radius_m) for reference in references])
    centre = np.array([reference.target_m[:2] for reference in references])
    altitude = np.array([reference.loiter_z_m for reference in references])

    def heights(row: IntArray, s_m: FloatArray) -> FloatArray:
        x, y = circle_points(centre[row], radius[row], s_m).T
        height: FloatArray = altitude[row] - ground_heights_m(x, y, terrain)
        return height

    def bounds(row: IntArray, a: FloatArray, b: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        x, y = circle_points(centre[row], radius[row], (a + b) / 2).T
        ground = ground_bounds(x, y, (b - a) / 2, terrain)
        start, end = heights(row, a), heights(row, b)
        lower = between(start, end, b - a, ground.slope, ground.bend + ground.slope / radius[row])
        return lower, np.minimum(start, end), np.where(start <= end, a, b)

    rounds = even(np.zeros(len(radius)), 2.0 * np.pi * radius, WIDTH_M)
    return least(len(radius), rounds, bounds, scenario.limits.clearance_m)


def circle_points(centre_m: FloatArray, radius_m: FloatArray, s_m: FloatArray) -> FloatArray:
    """(n, 2) points of circles about (n, 2), arc lengths (n,) anticlockwise from their easts."""
    angle = s_m / radius_m
    points: FloatArray = np.stack([radius_m * np.cos(angle), radius_m * np.sin(angle)], axis=-1)
    return centre_m + points


def _airborne_from_m(tracks: Tracks, heights: Callable[[IntArray, FloatArray], FloatArray]) -> FloatArray:
    """Arc length at which each path first has `AIRBORNE_M` below it; its length where it never has."""
    airborne = tracks.lengths_m.copy()
    left, start, span = np.arange(len(tracks)), 0.0, 100.0 * LOOK_M
    while len(left):
        s = np.arange(start, start + span, LOOK_M)
        row = np.repeat(left, len(s))
        high = heights(row, np.minimum(np.tile(s, len(left)), tracks.lengths_m[row])) >= AIRBORNE_M
        high = high.reshape(len(left), len(s))
        passed = high.any(axis=1)
        airborne[left[passed]] = s[np.argmax(high[passed], axis=1)]
        left, start, span = left[~passed & (tracks.lengths_m[left] > start + span)], start + span, 2.0 * span
    below: FloatArray = np.maximum(airborne - LOOK_M, 0.0)
    above: FloatArray = np.minimum(airborne, tracks.lengths_m)
    for _ in range(HALVINGS):
        middle = (below + above) / 2
        high = heights(np.arange(len(tracks)), middle) >= AIRBORNE_M
        below, above = np.where(high, below, middle), np.where(high, middle, above)
    return above
