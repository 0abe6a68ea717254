"""A fence around a vehicle in flight: whether it is inside, and how it has been crossed (ArduPlane's FENCE_*)."""

import math
from dataclasses import dataclass

from missions.errors import InputError
from missions.fence import Fence, FenceCircle
from missions.frame import LocalFrame
from missions.reference.reference import FARTHEST_M
from sitl.flight import Vector
from sitl.parameters import Parameters
from sitl.snapshot import Breach

ALT_MAX, CIRCLE, POLYGONS, ALT_MIN = 1, 2, 4, 8
"""Bits of FENCE_TYPE."""


@dataclass(frozen=True)
class Crossing:
    """A fence that is crossed, and by how much, for the pilot."""

    breach: Breach
    text: str


class FenceAreas:
    """Polygons and circles in the local frame.

    Args:
        fence: in degrees.
        frame: the local frame.

    Raises:
        InputError: part of it is too far away.
    """

    def __init__(self, fence: Fence, frame: LocalFrame) -> None:
        self._circles: list[tuple[bool, float, float, float]] = []
        self._polygons: list[tuple[bool, list[tuple[float, float]]]] = []
        self.return_point_m = None if fence.return_point is None else frame.from_e7(*fence.return_point)
        for area in fence.areas:
            if isinstance(area, FenceCircle):
                places = [frame.from_e7(*area.center)]
                self._circles.append((area.inclusion, *places[0], area.radius_m))
            else:
                places = [frame.from_e7(*vertex) for vertex in area.vertices]
                self._polygons.append((area.inclusion, places))
            if not all(math.hypot(*place) < FARTHEST_M for place in places):
                raise InputError(f"fence: more than {FARTHEST_M / 1000:g} km from the scenario's origin")

    def __bool__(self) -> bool:
        return bool(self._circles or self._polygons)

    def crossed(self, x_m: float, y_m: float) -> str | None:
        """Which area a place is not allowed by; None when all allow it."""
        for inclusion, centre_x, centre_y, radius_m in self._circles:
            if (math.hypot(x_m - centre_x, y_m - centre_y) <= radius_m) != inclusion:
                return "outside a circle to stay in" if inclusion else "inside a circle to stay out of"
        for inclusion, vertices in self._polygons:
            if _contains(vertices, x_m, y_m) != inclusion:
                return "outside a polygon to stay in" if inclusion else "inside a polygon to stay out of"
        return None


class FenceWatch:
    """What is set for the fence, applied to places; it remembers what has been crossed.

    Args:
        parameters: with FENCE_*.
    """

    def __init__(self, parameters: Parameters) -> None:
        self.areas: FenceAreas | None = None
        self.breached = False
        self.count = 0
        self.last = Breach.NONE
        self.last_time_s = 0.0
        self._parameters = parameters
        self._above_least = False

    @property
    def enabled(self) -> bool:
        """Whether it is heeded."""
        return self._parameters["FENCE_ENABLE"] == 1

    def missing(self) -> str | None:
        """Why there is nothing to heed; None when there is something."""
        kinds = int(self._parameters["FENCE_TYPE"])
        if kinds == 0:
            return "FENCE_TYPE is 0: no fence to heed"
        if kinds == POLYGONS and not self.areas:
            return "FENCE_TYPE wants polygons, and none are loaded"
        return None

    def crossing(self, position_m: Vector, home_m: Vector, *, heed_least: bool) -> Crossing | None:
        """The fence that a position is beyond; None inside.

        Args:
            heed_least: whether FENCE_ALT_MIN counts: not during take-off and landing.
        """
        settings, (x, y, z) = self._parameters, position_m
        kinds, above_m = int(settings["FENCE_TYPE"]), z - home_m[2]
        if kinds & ALT_MAX and above_m > settings["FENCE_ALT_MAX"]:
            return Crossing(Breach.MAXALT, f"{above_m:.0f} m above home, at most {settings['FENCE_ALT_MAX']:g}")
        if heed_least and kinds & ALT_MIN and above_m < settings["FENCE_ALT_MIN"]:
            return Crossing(Breach.MINALT, f"{above_m:.0f} m above home, at least {settings['FENCE_ALT_MIN']:g}")
        if kinds & CIRCLE:
            away_m = math.hypot(x - home_m[0], y - home_m[1])
            if away_m > settings["FENCE_RADIUS"]:
                return Crossing(Breach.BOUNDARY, f"{away_m:.0f} m from home, at most {settings['FENCE_RADIUS']:g}")
        if kinds & POLYGONS and self.areas and (what := self.areas.crossed(x, y)) is not None:
            return Crossing(Breach.BOUNDARY, what)
        return None

    def look(self, position_m: Vector, home_m: Vector, time_s: float, *, landing: bool) -> Crossing | bool | None:
        """Take in where it is in flight: the crossing when it has just gone outside, True when it is back inside."""
        if not self._above_least:
            self._above_least = position_m[2] - home_m[2] >= self._parameters["FENCE_ALT_MIN"]
        crossing = self.crossing(position_m, home_m, heed_least=self._above_least and not landing)
        if crossing is None:
            was_breached, self.breached = self.breached, False
            return True if was_breached else None
        if self.breached:
            return None
        self.breached = True
        self.count += 1
        self.last, self.last_time_s = crossing.breach, time_s
        return crossing

    def rest(self) -> None:
        """The flight is over, or the fence no longer heeded."""
        self.breached = self._above_least = False


def _contains(vertices: list[tuple[float, float]], x_m: float, y_m: float) -> bool:
    """Whether a place is inside a polygon, by the edges that a ray to the east crosses."""
    inside = False
    x0, y0 = vertices[-1]
    for x1, y1 in vertices:
        if (y1 > y_m) != (y0 > y_m) and x_m < x1 + (y_m - y1) / (y0 - y1) * (x0 - x1):
            inside = not inside
        x0, y0 = x1, y1
    return inside
