"""Which circles a vehicle flies, by what is set for it: radius, sense, airspeed, and above which ground."""

import math
from collections.abc import Callable

from missions.reference.reference import fillet_radius_m
from sitl.config import VehicleConfig
from sitl.flight import Vector
from sitl.guidance.loiter_law import Loiter
from sitl.parameters import Parameters
from sitl.stages.circle import CircleStage
from sitl.terrain_guard import TerrainGuard


class Circling:
    """Makes circles for one vehicle.

    Args:
        config: of the vehicle.
        parameters: AIRSPEED_*, WP_LOITER_RAD.
    """

    def __init__(self, config: VehicleConfig, parameters: Parameters) -> None:
        self._terrain = config.terrain
        self._wind_m_s = math.hypot(*config.forecast_wind_m_s)
        self._parameters = parameters

    def airspeeds(self) -> tuple[float, float, float]:
        """(least, greatest, cruise) airspeed that is set."""
        slow, fast = sorted((self._parameters["AIRSPEED_MIN"], self._parameters["AIRSPEED_MAX"]))
        return slow, fast, self._parameters["AIRSPEED_CRUISE"]

    def radius_m(self, asked_m: float) -> float:
        """A radius, positive clockwise: as asked, else WP_LOITER_RAD; never tighter than can be flown in the wind."""
        wanted = asked_m or self._parameters["WP_LOITER_RAD"]
        _, fast, cruise = self.airspeeds()
        return math.copysign(max(abs(wanted), fillet_radius_m(min(cruise, fast) + self._wind_m_s)), wanted)

    def loiter(self, place: Vector, asked_m: float) -> Loiter:
        """The circle round a place, by the radius that is asked for; 0 for the default."""
        radius_m = self.radius_m(asked_m)
        return Loiter(*place, abs(radius_m), -1.0 if radius_m > 0 else 1.0)

    def guarded(self, place: Vector, asked_m: float, warn: Callable[[float], None]) -> CircleStage:
        """The same as a stage that keeps above the ground; `warn` as for `TerrainGuard`."""
        guard = TerrainGuard(self._terrain, abs(self.radius_m(0.0)), warn)
        return CircleStage(self.loiter(place, asked_m), guard=guard)
