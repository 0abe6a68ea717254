"""A landing at the end of a mission: down in the circle of its loiter, out along a tangent, and straight to the ground.

The pattern that both autopilots land by: NAV_LOITER_TO_ALT, then NAV_LAND outside the circle.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt

from missions.commands import Command, Frame
from missions.environment import Environment, ground_heights_m
from missions.environment.obstacles import wall_distances_m
from missions.errors import InputError
from missions.frame import LocalFrame
from missions.mission import Mission, MissionItem
from missions.scenario import Scenario

FloatArray = npt.NDArray[np.float64]

GLIDE_SLOPE = math.tan(math.radians(4.0))
"""Steepest final: PX4 refuses more than FW_LND_ANG, 5 degrees unless changed."""
APPROACH_HEIGHT_M = 50.0
"""Of the circle's lowest turn, above all ground and obstacles below it."""
FINAL_M = (600.0, 4000.0)
"""Shortest and longest final."""
STEP_M = 25.0
LEVEL_WITHIN_M = 3.0
ROLL_OUT_M = 150.0
"""The ground is level from one step before the touchdown on for so long, and a step to both sides: no more than
`LEVEL_WITHIN_M` from it."""
HEADINGS = 36


@dataclass(frozen=True)
class Landing:
    """Where a vehicle comes down. Local frame, metres.

    Attributes:
        centre_m: (x, y) of the circle.
        radius_m: of the circle; positive turns clockwise.
        altitude_m: of its lowest turn.
        final_m: (n, 2) points from the circle to the touchdown.
        ground_m: height of the ground there.
    """

    centre_m: tuple[float, float]
    radius_m: float
    altitude_m: float
    final_m: FloatArray
    ground_m: float

    def way_m(self) -> FloatArray:
        """(n, 3) points of the lowest turn and the final."""
        turn = self.centre_m + abs(self.radius_m) * _directions(HEADINGS)
        heights = np.linspace(self.altitude_m, self.ground_m, len(self.final_m))
        level = np.full(len(turn), self.altitude_m)
        return np.vstack([np.column_stack([turn, level]), np.column_stack([self.final_m, heights])])


def landings(scenario: Scenario, missions: Mapping[int, Mission]) -> dict[int, Landing]:
    """A landing for each mission's last loiter by sysid, apart from all others.

    Raises:
        InputError: a mission does not end in a loiter, circles meet, or there is no ground to land on.
    """
    frame, circles = scenario.frame, {}
    for sysid, mission in missions.items():
        loiter = mission[-1]
        if loiter.command != Command.NAV_LOITER_UNLIM or loiter.frame != Frame.GLOBAL:
            raise InputError(f"vehicle {sysid}: its mission does not end in a loiter, so there is none to land from")
        circles[sysid] = (*frame.from_e7(loiter.lat_e7, loiter.lon_e7), loiter.alt_m - frame.alt_m, loiter.param3)
    found: dict[int, Landing] = {}
    for sysid, (x, y, z, radius_m) in circles.items():
        others = [(*circle[:2], abs(circle[3])) for other, circle in circles.items() if other != sysid]
        apart_m = [math.hypot(x - a, y - b) - abs(radius_m) - r for a, b, r in others]
        if min(apart_m, default=math.inf) < scenario.limits.separation_m:
            raise InputError(
                f"vehicle {sysid}: its circle is nearer than limits.separation_m to another's, and all come down at "
                "the same time; leave --landing out and land them one by one, or move the targets apart"
            )
        landing = _find(scenario, (x, y), z, radius_m, others, list(found.values()))
        if landing is None:
            raise InputError(
                f"vehicle {sysid}: no level ground within {FINAL_M[1] / 1000:g} km of its target that a final of "
                "4 degrees leads to; leave --landing out, or move its target"
            )
        found[sysid] = landing
    return found


def with_landing(mission: Mission, landing: Landing, frame: LocalFrame) -> Mission:
    """A mission that ends with a landing in place of its loiter; altitudes AMSL."""
    loiter = mission[-1]
    down = replace(
        loiter,
        command=Command.NAV_LOITER_TO_ALT,
        param1=1.0,  # leave it towards the next item only
        param2=loiter.param3,
        param3=0.0,
        param4=1.0,  # along the tangent
        alt_m=landing.altitude_m + frame.alt_m,
    )
    lat_e7, lon_e7 = frame.to_e7(*landing.final_m[-1].tolist())
    land = MissionItem(
        Command.NAV_LAND, Frame.GLOBAL, lat_e7=lat_e7, lon_e7=lon_e7, alt_m=landing.ground_m + frame.alt_m
    )
    return Mission((*mission.items[:-1], down, land))


def _find(
    scenario: Scenario,
    centre_m: tuple[float, float],
    z_m: float,
    radius_m: float,
    others: Sequence[tuple[float, float, float]],
    taken: Sequence[Landing],
) -> Landing | None:
    """The shortest landing, against the forecast wind before with it."""
    environment, limits = scenario.environment, scenario.limits
    altitude_m = min(_floor_m(environment, centre_m, radius_m, limits.obstacle_margin_m) + APPROACH_HEIGHT_M, z_m)
    best: tuple[bool, float, Landing] | None = None
    for direction in _directions(HEADINGS):
        leave = centre_m + radius_m * np.array([-direction[1], direction[0]])
        line = leave + np.arange(0.0, FINAL_M[1] + ROLL_OUT_M + STEP_M, STEP_M)[:, np.newaxis] * direction
        aside = STEP_M * np.array([[[0.0, 0.0]], [[-direction[1], direction[0]]], [[direction[1], -direction[0]]]])
        strip = line + aside
        ground = ground_heights_m(strip[..., 0], strip[..., 1], environment.terrain)
        clear = _clear_until(line, environment, limits.obstacle_margin_m, limits.separation_m, others, taken)
        with_wind = bool(direction @ scenario.wind.forecast_m_s > 0.0)
        for last in range(int(FINAL_M[0] / STEP_M), clear):
            if best is not None and (with_wind, last * STEP_M) >= best[:2]:
                break
            if _can_land(ground, last, altitude_m):
                final = Landing(centre_m, radius_m, altitude_m, line[: last + 1], float(ground[0, last]))
                best = (with_wind, last * STEP_M, final)
                break
    return best[2] if best is not None else None


def _can_land(ground: FloatArray, last: int, altitude_m: float) -> bool:
    """Whether a final can end at step `last` of a line: not too steep, over lower ground, on level ground.

    `ground` is (3, n): heights along the line, and a step left and right of it.
    """
    below = ground[0, : last + 1]
    height = altitude_m - below[last]
    if not 0.0 < height <= GLIDE_SLOPE * last * STEP_M:
        return False
    share = 1.0 - np.arange(last + 1) / last
    if (below - below[last] > 0.5 * height * share + LEVEL_WITHIN_M).any():
        return False
    runway = ground[:, last - 1 : last + 1 + int(ROLL_OUT_M / STEP_M)]
    return bool((np.abs(runway - below[last]) <= LEVEL_WITHIN_M).all())


def _clear_until(
    line: FloatArray,
    environment: Environment,
    obstacle_margin_m: float,
    separation_m: float,
    others: Sequence[tuple[float, float, float]],
    taken: Sequence[Landing],
) -> int:
    """How many steps of a line are clear of obstacles, of the area's edge and of others' circles and finals, roll-out
    included."""
    area = environment.area
    blocked = (line < [area.x_min_m, area.y_min_m]).any(axis=1) | (line > [area.x_max_m, area.y_max_m]).any(axis=1)
    for obstacle in environment.obstacles:
        low = np.column_stack([line, np.full(len(line), -math.inf)])
        blocked |= wall_distances_m(low, obstacle) < obstacle_margin_m
    for x, y, radius_m in others:
        blocked |= np.hypot(line[:, 0] - x, line[:, 1] - y) < radius_m + separation_m
    for landing in taken:
        gaps = np.linalg.norm(line[:, np.newaxis] - landing.final_m, axis=-1)
        blocked |= (gaps < separation_m).any(axis=1)
    first = int(np.argmax(blocked)) if blocked.any() else len(line)
    return first - int(ROLL_OUT_M / STEP_M)


def _floor_m(
    environment: Environment, centre_m: tuple[float, float], radius_m: float, obstacle_margin_m: float
) -> float:
    """The highest ground or obstacle's top below a circle's disc."""
    reach_m = abs(radius_m) + obstacle_margin_m
    rings = np.linspace(0.0, reach_m, math.ceil(reach_m / STEP_M) + 1)[:, np.newaxis, np.newaxis] * _directions(
        HEADINGS
    )
    disc = rings + centre_m
    floor = float(ground_heights_m(disc[..., 0], disc[..., 1], environment.terrain).max())
    for obstacle in environment.obstacles:
        if math.hypot(obstacle.x_m - centre_m[0], obstacle.y_m - centre_m[1]) < obstacle.radius_m + reach_m:
            floor = max(floor, obstacle.top_m)
    return floor


def _directions(count: int) -> FloatArray:
    """(count, 2) unit vectors all around."""
    angles = np.linspace(0.0, 2.0 * math.pi, count, endpoint=False)
    return np.column_stack([np.cos(angles), np.sin(angles)])
