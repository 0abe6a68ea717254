"""A plan as maps and globes show it: tracks over time, and what stands in the area."""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.float64]

LatLon = tuple[float, float]
"""Latitude and longitude in degrees."""

ALTITUDE_NOTE = "Altitudes are metres above mean sea level (AMSL), as planned."
ELLIPSOID_NOTE = (
    "Altitudes are metres above mean sea level (AMSL), as planned. This format counts them from the WGS84 ellipsoid; "
    "Skein knows no geoid and does not convert, so all is shown too low or too high by the geoid's height there: "
    "the same for all to some metres."
)


@dataclass(frozen=True)
class Stop:
    """An item of a mission that has a place.

    Attributes:
        seq: the item's number.
        name: what it is, such as "waypoint".
        lat_deg, lon_deg, alt_m: where; AMSL.
        acceptance_m: radius of a waypoint; None for others.
        airspeed_m_s: told for the way to it; None before any was.
        time_s: planned time of passing since launch; None where there is none.
    """

    seq: int
    name: str
    lat_deg: float
    lon_deg: float
    alt_m: float
    acceptance_m: float | None
    airspeed_m_s: float | None
    time_s: float | None


@dataclass(frozen=True)
class Track:
    """What one vehicle is to fly.

    Attributes:
        sysid, name: of the vehicle.
        colour: "#rrggbb".
        time_s: (n,) since launch.
        lat_deg, lon_deg, alt_m: (n,) planned places; AMSL.
        speed_m_s: (n,) planned speeds over ground.
        stops: the mission's places, home first.
    """

    sysid: int
    name: str
    colour: str
    time_s: FloatArray
    lat_deg: FloatArray
    lon_deg: FloatArray
    alt_m: FloatArray
    speed_m_s: FloatArray
    stops: tuple[Stop, ...]


@dataclass(frozen=True)
class Round:
    """A radar (a sphere) or an obstacle (a cylinder).

    Attributes:
        name: such as "radar 1".
        lat_deg, lon_deg: of its axis.
        radius_m: its own.
        bottom_m, top_m: altitudes AMSL.
        rim: its outline from above, anticlockwise, the first place not repeated.
    """

    name: str
    lat_deg: float
    lon_deg: float
    radius_m: float
    bottom_m: float
    top_m: float
    rim: tuple[LatLon, ...]

    @property
    def middle_m(self) -> float:
        """Altitude AMSL halfway up."""
        return (self.bottom_m + self.top_m) / 2.0


@dataclass(frozen=True)
class Scene:
    """A plan, or one vehicle's part of it, and its surroundings.

    Attributes:
        name, description: of the scenario.
        tracks: of the vehicles.
        radars, obstacles: what stands in the area.
        area: its corners, anticlockwise, the first not repeated.
    """

    name: str
    description: str
    tracks: tuple[Track, ...]
    radars: tuple[Round, ...]
    obstacles: tuple[Round, ...]
    area: tuple[LatLon, ...]


RADAR_COLOUR = "#d9822b"
OBSTACLE_COLOUR = "#5b6573"
AREA_COLOUR = "#222222"
EPOCH = "2026-01-01T00:00:00Z"
"""The moment of launch, where a format wants a date: plans have none."""
