"""Keeping above the ground on the way to a circle, and on it."""

import math
from collections.abc import Callable

from missions.environment.terrain import Terrain, ground_height_m
from sitl.flight import Flight, Vector
from sitl.guidance.loiter_law import Loiter
from sitl.ticks import TICK_S

CLEARANCE_M = 30.0
CLIMB_GRADIENT = 0.08
"""What it can climb on the way, with something to spare."""
LOOK_EVERY_TICKS = round(1.0 / TICK_S)
STEP_M = 50.0
MOST_STEPS = 400
STRAIGHT_AHEAD_S = 12.0
"""It flies on along its course for this long before it has turned."""
TOO_LOW_M = 25.0
"""So far below what the way ahead needs, it first circles up."""


class TerrainGuard:
    """Raises what is flown above the ground ahead, and says so.

    Args:
        terrain: below.
        turn_radius_m: of a circle up, where the way ahead is too steep.
        warn: told once the altitude that it will take, metres above the datum.
    """

    def __init__(self, terrain: Terrain, turn_radius_m: float, warn: Callable[[float], None]) -> None:
        self._terrain = terrain
        self._turn_radius_m = turn_radius_m
        self._warn = warn
        self._warned = False
        self._circle_floor_m: float | None = None
        self._floor_m = -math.inf
        self._highest_m = -math.inf
        self._up: Loiter | None = None

    def above_ground(self, loiter: Loiter, flight: Flight, ground_velocity: Vector, tick: int) -> Loiter:
        """The loiter to fly now: at a safe altitude, or round here first while the way there is too steep."""
        if self._circle_floor_m is None:
            self._circle_floor_m = self.floor_of(loiter)
        if self._floor_m == -math.inf or tick % LOOK_EVERY_TICKS == 0:
            self._look(loiter, flight, ground_velocity)
        if self._up is not None:
            return self._up
        z_m = max(loiter.z_m, self._circle_floor_m, self._floor_m)
        if z_m > loiter.z_m + 1.0:
            self._tell()
        return loiter._replace(z_m=z_m)

    def floor_of(self, loiter: Loiter) -> float:
        """The lowest altitude of that circle with clearance."""
        rings = [share * (loiter.radius_m + STEP_M) for share in (0.0, 0.25, 0.5, 0.75, 1.0)]
        angles = [2.0 * math.pi * i / 24 for i in range(24)]
        return CLEARANCE_M + max(
            self._ground(loiter.x_m + ring * math.cos(angle), loiter.y_m + ring * math.sin(angle))
            for ring in rings
            for angle in angles
        )

    def _look(self, loiter: Loiter, flight: Flight, velocity: Vector) -> None:
        """What altitude the way ahead needs here: straight to the circle, and on along the present course."""
        air = flight.air
        away_m = math.hypot(loiter.x_m - air.x, loiter.y_m - air.y)
        needed = max(
            self._needed(flight, math.atan2(loiter.y_m - air.y, loiter.x_m - air.x), away_m),
            self._needed(flight, math.atan2(velocity[1], velocity[0]), STRAIGHT_AHEAD_S * math.hypot(*velocity[:2])),
        )
        self._floor_m = needed
        if self._up is not None:
            if air.h >= needed:
                self._up = None
        elif away_m > 2.0 * loiter.radius_m and air.h < needed - TOO_LOW_M:
            self._up = self._circle_up(flight, math.atan2(velocity[1], velocity[0]), needed)
            self._tell()

    def _needed(self, flight: Flight, course: float, distance_m: float) -> float:
        steps = min(max(math.ceil(distance_m / STEP_M), 1), MOST_STEPS)
        step_m = distance_m / steps
        cos_course, sin_course, needed = math.cos(course), math.sin(course), -math.inf
        for i in range(steps + 1):
            along_m = i * step_m
            ground = self._ground(flight.air.x + along_m * cos_course, flight.air.y + along_m * sin_course)
            needed = max(needed, ground - CLIMB_GRADIENT * along_m)
            self._highest_m = max(self._highest_m, ground + CLEARANCE_M)
        return needed + CLEARANCE_M

    def _circle_up(self, flight: Flight, course: float, needed_m: float) -> Loiter:
        """Beside the course, on the side with the lower ground."""
        air, radius_m = flight.air, self._turn_radius_m
        sides = [
            Loiter(
                air.x - turn * radius_m * math.sin(course),
                air.y + turn * radius_m * math.cos(course),
                needed_m + TOO_LOW_M,
                radius_m,
                turn,
            )
            for turn in (1.0, -1.0)
        ]
        lower = min(sides, key=self.floor_of)
        return lower._replace(z_m=max(lower.z_m, self.floor_of(lower)))

    def _ground(self, x_m: float, y_m: float) -> float:
        return ground_height_m(x_m, y_m, self._terrain)

    def _tell(self) -> None:
        if not self._warned:
            self._warned = True
            self._warn(max(self._highest_m, self._circle_floor_m or 0.0))
