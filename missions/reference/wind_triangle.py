"""Between airspeed and ground speed on a track, in a known steady wind (MODEL, section 6, Schedule)."""

import math


def airspeed_on_track(ground_speed_m_s: float, slope: float, heading: float, wind_m_s: tuple[float, float]) -> float:
    """Airspeed of a flight along a track.

    Args:
        ground_speed_m_s: horizontal speed over ground.
        slope: dz/ds of the track, over horizontal arc length.
        heading: of the track, radians anticlockwise from +x.
        wind_m_s: (east, north).
    """
    u = ground_speed_m_s * math.cos(heading) - wind_m_s[0]
    v = ground_speed_m_s * math.sin(heading) - wind_m_s[1]
    return math.sqrt(u * u + v * v + (ground_speed_m_s * slope) ** 2)


def ground_speed_on_track(airspeed_m_s: float, slope: float, heading: float, wind_m_s: tuple[float, float]) -> float:
    """Horizontal ground speed of a flight along a track at an airspeed: the inverse of `airspeed_on_track`.

    Raises:
        ValueError: the wind is too strong to make way along the track.
    """
    along = wind_m_s[0] * math.cos(heading) + wind_m_s[1] * math.sin(heading)
    wind_squared = wind_m_s[0] ** 2 + wind_m_s[1] ** 2
    a = 1.0 + slope * slope
    discriminant = along * along - a * (wind_squared - airspeed_m_s**2)
    speed = (along + math.sqrt(discriminant)) / a if discriminant >= 0.0 else 0.0
    if speed <= 0.0:
        raise ValueError(
            f"at {airspeed_m_s:.1f} m/s airspeed a wind of {math.sqrt(wind_squared):.1f} m/s lets nothing through"
        )
    return speed
