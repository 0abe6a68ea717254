"""The verifier's single checks of one UAV's filleted path. Each gives the figure and a list of what is wrong: one line
that says where and by how much."""

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from missions.environment import ground_heights_m
from missions.environment.obstacles import wall_distances_m
from missions.environment.terrain import AIRBORNE_M
from missions.mission import Mission
from missions.reference import Reference, airspeed_on_track
from missions.reference.reference import fillet_radius_m
from missions.scenario import Scenario, VehicleModel
from planner.limits import POWER_SHARE, airspeed_range_m_s, power_share

FloatArray = npt.NDArray[np.float64]

STEP_M = 5.0
END_TOLERANCE_M = 1.0
"""Between a mission's ends and the scenario's origin and target."""
CIRCLE = np.linspace(0.0, 2.0 * np.pi, 180, endpoint=False)
TOLERANCE_M = 0.05
"""The wire's own resolution: 1.1 cm of latitude and longitude, and what that does to the ground below."""
TOLERANCE = 1e-3
"""The same for speeds and angles, relative."""
RADIUS_TOLERANCE = 0.01
"""Fillets are fit for ground speeds before the fillets shorten the legs."""


@dataclass(frozen=True)
class PathSamples:
    """One UAV's path: its reference, samples at most `STEP_M` apart, and its corners as the wire carries them.

    `s_m` (n,), `points_m` (n, 3), `corners_m` (m, 3).
    """

    reference: Reference
    s_m: FloatArray
    points_m: FloatArray
    corners_m: FloatArray


def sample(mission: Mission, reference: Reference, scenario: Scenario) -> PathSamples:
    """Sample a mission's reference."""
    s_m = np.linspace(0.0, reference.length_m, math.ceil(reference.length_m / STEP_M) + 1)
    frame = scenario.frame
    items = [mission[seq] for seq in reference.corner_seq]
    corners = [(*frame.from_e7(item.lat_e7, item.lon_e7), item.alt_m - frame.alt_m) for item in items]
    return PathSamples(reference, s_m, reference.points(s_m), np.array(corners))


def place(point_m: FloatArray) -> str:
    """A point for a message."""
    return f"({point_m[0]:.0f}, {point_m[1]:.0f}, {point_m[2]:.0f})"


def clearance(path: PathSamples, scenario: Scenario) -> tuple[float, list[str]]:
    """Least height above ground once airborne; what is wanted grows from 0 over limits.climb_out_m."""
    limits = scenario.limits
    x, y, z = path.points_m.T
    above = z - ground_heights_m(x, y, scenario.environment.terrain)
    wanted = limits.clearance_m * np.minimum(1.0, path.s_m / limits.climb_out_m)
    high = np.flatnonzero(above >= AIRBORNE_M)
    airborne = int(high[0]) if len(high) else len(above)
    wanted[:airborne] = 0.0
    k = int(np.argmin(above - wanted))
    faults = []
    if above[k] < wanted[k] - TOLERANCE_M:
        faults.append(
            f"{above[k]:.0f} m above ground at {place(path.points_m[k])}, {wanted[k] - above[k]:.1f} m less than "
            "limits.clearance_m asks for"
        )
    least = float(above[airborne:].min()) if len(high) else float(above.min())
    return least, faults


def walls(path: PathSamples, scenario: Scenario) -> tuple[float, list[str]]:
    """Least distance from any obstacle's wall; infinite without obstacles."""
    least, faults, wanted = math.inf, [], scenario.limits.obstacle_margin_m
    for i, obstacle in enumerate(scenario.environment.obstacles):
        distances = wall_distances_m(path.points_m, obstacle)
        k = int(np.argmin(distances))
        least = min(least, float(distances[k]))
        if distances[k] < wanted - TOLERANCE_M:
            faults.append(
                f"{distances[k]:.0f} m from obstacles[{i}] at {place(path.points_m[k])}, "
                f"limits.obstacle_margin_m is {wanted:g}"
            )
    return least, faults


def turns(path: PathSamples, turn_max_deg: float) -> tuple[float, list[str]]:
    """Largest turn at a corner."""
    legs = np.diff(path.corners_m[:, :2], axis=0)
    cross = legs[:-1, 0] * legs[1:, 1] - legs[:-1, 1] * legs[1:, 0]
    turned = np.abs(np.degrees(np.arctan2(cross, np.sum(legs[:-1] * legs[1:], axis=1))))
    faults = [
        f"turns by {turned[k]:.1f} deg at {place(path.corners_m[k + 1])}, limits.turn_max_deg is {turn_max_deg:g}"
        for k in np.flatnonzero(turned > turn_max_deg * (1 + TOLERANCE))
    ]
    return float(turned.max(initial=0.0)), faults


def climbs(path: PathSamples, climb_max_deg: float) -> tuple[float, float, list[str]]:
    """Steepest climb and steepest descent along the samples, both positive."""
    angles = np.degrees(np.arctan(np.diff(path.points_m[:, 2]) / np.diff(path.s_m)))
    faults = []
    for k in {int(np.argmax(angles)), int(np.argmin(angles))}:
        if abs(angles[k]) > climb_max_deg * (1 + TOLERANCE):
            where = place(path.points_m[k])
            faults.append(f"climbs at {angles[k]:.1f} deg at {where}, limits.climb_max_deg is {climb_max_deg:g}")
    return max(0.0, float(angles.max())), max(0.0, -float(angles.min())), faults


def legs(path: PathSamples, leg_min_m: float, leg_max_m: float) -> tuple[float, float, list[str]]:
    """Shortest and longest leg between corners."""
    lengths = np.linalg.norm(np.diff(path.corners_m, axis=0), axis=1)
    faults = [
        f"leg {k + 1} from {place(path.corners_m[k])} is {length:.0f} m long, limits.leg_min_m and leg_max_m are "
        f"{leg_min_m:g} and {leg_max_m:g}"
        for k, length in enumerate(lengths)
        if not leg_min_m - TOLERANCE_M <= length <= leg_max_m + TOLERANCE_M
    ]
    return float(lengths.min()), float(lengths.max()), faults


def speeds(path: PathSamples, scenario: Scenario) -> tuple[float, float, float, list[str]]:
    """Least and largest airspeed of a leg in the forecast wind, and the largest part of the power that one takes."""
    airframe, wind = scenario.airframe.airframe(), scenario.wind.forecast_m_s
    slowest, fastest = airspeed_range_m_s(scenario)
    airspeeds, shares, faults = [], [], []
    reference = path.reference
    for k, leg in enumerate(np.diff(path.corners_m, axis=0)):
        ground, slope = float(reference.leg_ground_speed_m_s[k]), float(reference.leg_slope[k])
        airspeed = airspeed_on_track(ground, slope, math.atan2(leg[1], leg[0]), wind)
        climb_m_s = ground * slope
        share = power_share(airspeed, climb_m_s / airspeed, airframe)
        airspeeds.append(airspeed)
        shares.append(share)
        where = f"on leg {k + 1} from {place(path.corners_m[k])}"
        if not slowest * (1 - TOLERANCE) <= airspeed <= fastest * (1 + TOLERANCE):
            faults.append(f"airspeed {airspeed:.1f} m/s {where}, planned airspeeds lie in {slowest:g} to {fastest:g}")
        if share > POWER_SHARE + TOLERANCE:
            faults.append(f"takes {share:.0%} of the power there is {where}, {POWER_SHARE:.0%} may be planned")
        if not airframe.climb_rate_min_m_s - TOLERANCE <= climb_m_s <= airframe.climb_rate_max_m_s + TOLERANCE:
            faults.append(f"climbs at {climb_m_s:.1f} m/s {where}, outside the airframe's climb rates")
    return min(airspeeds), max(airspeeds), max(shares), faults


def box(path: PathSamples, scenario: Scenario) -> tuple[float, list[str]]:
    """Highest altitude of path and loiter; the area (1) holds on all sides of the path."""
    area = scenario.environment.area
    low = np.array([area.x_min_m, area.y_min_m, area.z_min_m])
    high = np.array([area.x_max_m, area.y_max_m, min(area.z_max_m, scenario.limits.altitude_max_m)])
    outside = np.max(np.maximum(low - path.points_m, path.points_m - high), axis=1)
    k = int(np.argmax(outside))
    faults = []
    if outside[k] > TOLERANCE_M:
        faults.append(f"{outside[k]:.0f} m outside the area or above the highest altitude at {place(path.points_m[k])}")
    if path.reference.loiter_z_m > high[2] + TOLERANCE_M:
        faults.append(f"loiters at {path.reference.loiter_z_m:.0f} m, above the highest altitude, {high[2]:.0f} m")
    return max(float(path.points_m[:, 2].max()), path.reference.loiter_z_m), faults


def ends(mission: Mission, reference: Reference, vehicle: VehicleModel, scenario: Scenario) -> list[str]:
    """Whether a mission leads from the scenario's origin to its target."""
    home = mission.home
    start = (*scenario.frame.from_e7(home.lat_e7, home.lon_e7), home.alt_m - scenario.frame.alt_m)
    pairs = (("starts", start, scenario.origin_m(vehicle)), ("ends", reference.target_m, scenario.target_m(vehicle)))
    return [
        f"{verb} at {place(np.array(here))}, {distance:.0f} m from where the scenario has it"
        for verb, here, wanted in pairs
        if (distance := math.dist(here, wanted)) > END_TOLERANCE_M
    ]


def loiter(reference: Reference, scenario: Scenario) -> list[str]:
    """Whether the circle at the end keeps clear of ground and walls and inside the area."""
    x, y, _ = reference.target_m
    radius, z = abs(reference.loiter_radius_m), reference.loiter_z_m
    circle = np.stack([x + radius * np.cos(CIRCLE), y + radius * np.sin(CIRCLE), np.full_like(CIRCLE, z)], axis=-1)
    limits, environment = scenario.limits, scenario.environment
    area, faults = environment.area, []
    above = z - ground_heights_m(circle[:, 0], circle[:, 1], environment.terrain)
    if above.min() < limits.clearance_m - TOLERANCE_M:
        faults.append(f"loiters {above.min():.0f} m above ground, limits.clearance_m is {limits.clearance_m:g}")
    for i, obstacle in enumerate(environment.obstacles):
        if (distance := float(wall_distances_m(circle, obstacle).min())) < limits.obstacle_margin_m - TOLERANCE_M:
            faults.append(f"loiters {distance:.0f} m from obstacles[{i}], not {limits.obstacle_margin_m:g}")
    if min(x - area.x_min_m, area.x_max_m - x, y - area.y_min_m, area.y_max_m - y) < radius:
        faults.append(f"loiters at {place(circle[0])} with a radius of {radius:.0f} m, partly outside the area")
    return faults


def fillets(path: PathSamples) -> list[str]:
    """Corners whose arc found no room for the radius that the fastest leg asks for."""
    wanted = fillet_radius_m(float(path.reference.leg_ground_speed_m_s.max()))
    radii = path.reference.path.corner_radius_m
    return [
        f"only room for a radius of {radii[k]:.0f} m at {place(path.corners_m[k])}, {wanted:.0f} m are flown"
        for k in np.flatnonzero(radii < wanted * (1 - RADIUS_TOLERANCE))
    ]
