"""The local frame: x east, y north in metres around the scenario's origin; z is altitude above its datum."""

import math
from dataclasses import dataclass

from missions.geodesic import direct, inverse
from missions.mission import degrees_to_e7


@dataclass(frozen=True)
class LocalFrame:
    """Azimuthal equidistant projection (WGS84) centred on the scenario's origin (MODEL, section 1).

    Args:
        lat_deg, lon_deg: the origin.
        alt_m: altitude AMSL of z = 0.
    """

    lat_deg: float
    lon_deg: float
    alt_m: float

    def to_local(self, lat_deg: float, lon_deg: float) -> tuple[float, float]:
        """Degrees to (x, y) in metres; infinite where there is no such latitude."""
        if not abs(lat_deg) <= 90.0:
            return math.inf, math.inf
        distance_m, azimuth = inverse(
            math.radians(self.lat_deg), math.radians(lat_deg), math.radians(lon_deg - self.lon_deg)
        )
        return distance_m * math.sin(azimuth), distance_m * math.cos(azimuth)

    def to_geodetic(self, x_m: float, y_m: float) -> tuple[float, float]:
        """(x, y) in metres to (latitude, longitude) in degrees."""
        phi, east = direct(math.radians(self.lat_deg), math.sqrt(x_m * x_m + y_m * y_m), math.atan2(x_m, y_m))
        lon_deg = self.lon_deg + math.degrees(east)
        return math.degrees(phi), (lon_deg + 180.0) % 360.0 - 180.0 if abs(lon_deg) > 180.0 else lon_deg

    def to_e7(self, x_m: float, y_m: float) -> tuple[int, int]:
        """(x, y) in metres to (latitude, longitude) in the wire's 1e-7 degrees."""
        lat_deg, lon_deg = self.to_geodetic(x_m, y_m)
        return degrees_to_e7(lat_deg), degrees_to_e7(lon_deg)

    def from_e7(self, lat_e7: int, lon_e7: int) -> tuple[float, float]:
        """The wire's 1e-7 degrees to (x, y) in metres."""
        return self.to_local(lat_e7 / 1e7, lon_e7 / 1e7)
