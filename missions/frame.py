"""The local frame: x east, y north in metres around the scenario's origin; z is altitude above its datum."""

from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt
from pyproj import Proj

from missions.mission import degrees_to_e7

FloatArray = npt.NDArray[np.float64]


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
    _projection: Proj = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        projection = Proj(proj="aeqd", ellps="WGS84", lat_0=self.lat_deg, lon_0=self.lon_deg)
        object.__setattr__(self, "_projection", projection)

    def to_local(self, lat_deg: float, lon_deg: float) -> tuple[float, float]:
        """Degrees to (x, y) in metres."""
        x, y = self._projection(lon_deg, lat_deg)
        return float(x), float(y)

    def to_geodetic(self, x_m: float, y_m: float) -> tuple[float, float]:
        """(x, y) in metres to (latitude, longitude) in degrees."""
        lon_deg, lat_deg = self._projection(x_m, y_m, inverse=True)
        return float(lat_deg), float(lon_deg)

    def to_geodetic_many(self, x_m: FloatArray, y_m: FloatArray) -> tuple[FloatArray, FloatArray]:
        """The same for arrays of one shape."""
        lon_deg, lat_deg = self._projection(x_m, y_m, inverse=True)
        return lat_deg, lon_deg

    def to_e7(self, x_m: float, y_m: float) -> tuple[int, int]:
        """(x, y) in metres to (latitude, longitude) in the wire's 1e-7 degrees."""
        lat_deg, lon_deg = self.to_geodetic(x_m, y_m)
        return degrees_to_e7(lat_deg), degrees_to_e7(lon_deg)

    def from_e7(self, lat_e7: int, lon_e7: int) -> tuple[float, float]:
        """The wire's 1e-7 degrees to (x, y) in metres."""
        return self.to_local(lat_e7 / 1e7, lon_e7 / 1e7)
